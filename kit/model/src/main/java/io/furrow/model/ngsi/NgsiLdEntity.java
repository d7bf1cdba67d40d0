package io.furrow.model.ngsi;

import java.time.Instant;
import java.util.Comparator;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.BinaryOperator;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.time.Instants;

/**
 * Converts an NGSI-LD entity, normalized, concise or simplified, to an NGSI-v2 normalized entity.
 *
 * <table>
 * <caption>Members of the entity</caption>
 * <tr><td>{@code id}, {@code type}</td><td>the same; several types become one text, joined by commas</td></tr>
 * <tr><td>{@code @context}</td><td>dropped: names stay as the context broker compacted them</td></tr>
 * <tr><td>{@code createdAt}, {@code modifiedAt}, {@code expiresAt}</td>
 *     <td>{@code dateCreated}, {@code dateModified}, {@code dateExpires}, type {@code DateTime}</td></tr>
 * <tr><td>{@code deletedAt}</td><td>the same, type {@code DateTime}, and {@code alterationType} = {@code entityDelete}</td></tr>
 * <tr><td>{@code scope}</td><td>an attribute, type {@code Text} or {@code StructuredValue}</td></tr>
 * <tr><td>anything else</td><td>an attribute, see {@link NgsiLdAttribute}</td></tr>
 * <tr><td>an attribute with several instances</td><td>the one without {@code datasetId} under the attribute's name, each
 *     other under {@code <name>:<datasetId>}; of several with one {@code datasetId}, or without, the newest by {@code observedAt}, or else
 *     {@code modifiedAt}</td></tr>
 * </table>
 *
 * <p>If the entity has no time in {@code Time}, {@code TimeInstant}, {@code dateObserved}, {@code timestamp}, the newest
 * {@code observedAt} of its attributes becomes its attribute {@code TimeInstant}, as an IoT Agent sets it; not if an
 * attribute without {@code observedAt} was modified later than all that have one.
 */
final class NgsiLdEntity {
    private static final Map<String, String> BUILT_INS = Map.of(
            "createdAt", "dateCreated",
            "modifiedAt", "dateModified",
            "expiresAt", "dateExpires",
            "deletedAt", "deletedAt");
    private static final Set<String> DEVICE_TIMES = Set.of("Time", "TimeInstant", "dateObserved", "timestamp");

    private final ObjectNode normalized = JsonNodeFactory.instance.objectNode();
    /** The newest {@code modifiedAt} of the attributes with and without {@code observedAt}. */
    private final Map<Boolean, Instant> modified = new HashMap<>();

    private Optional<String> newestObservation = Optional.empty();

    private NgsiLdEntity() {}

    /** Returns whether a bare entity has a context or an attribute of a kind without NGSI-v2's metadata. */
    static boolean looksLike(JsonNode entity) {
        return entity.isObject()
                && (entity.has("@context")
                        || entity.valueStream()
                                .anyMatch(attribute -> NgsiLdAttribute.isNormalized(attribute)
                                        && !attribute.has("metadata")
                                        && !attribute.path("type").textValue().equals("Property")));
    }

    static Entity read(JsonNode reported) throws UnreadableException {
        Reason.NOT_AN_ENTITY.refuseIf(!reported.isObject(), "an NGSI-LD entity is a JSON object");
        JsonNode id = reported.path("id");
        Reason.NOT_AN_ENTITY.refuseIf(
                !id.isTextual() || id.textValue().isBlank(), "the entity has no member 'id' with a text");
        NgsiLdEntity entity = new NgsiLdEntity();
        entity.normalized.set("id", id);
        if (reported.has("type")) {
            entity.normalized.put("type", type(reported.get("type")));
        }
        for (Map.Entry<String, JsonNode> member : reported.properties()) {
            entity.add(member.getKey(), member.getValue());
        }
        entity.addTime();
        EntityLimits.check(entity.normalized);
        return new Entity(entity.normalized);
    }

    /** Returns the entity of a feature of a GeoJSON notification, whose properties contain the entity's members. */
    static JsonNode ofFeature(JsonNode feature) {
        if (!feature.path("properties").isObject()) {
            return feature;
        }
        ObjectNode entity = JsonNodeFactory.instance.objectNode();
        entity.set("id", feature.get("id"));
        return entity.setAll((ObjectNode) feature.get("properties"));
    }

    private static String type(JsonNode type) throws UnreadableException {
        boolean several =
                type.isArray() && !type.isEmpty() && type.valueStream().allMatch(JsonNode::isTextual);
        Reason.NOT_AN_ENTITY.refuseIf(
                !type.isTextual() && !several, "the type of the entity is neither text nor a list of texts");
        return several
                ? type.valueStream().map(JsonNode::textValue).collect(Collectors.joining(","))
                : type.textValue();
    }

    private void add(String name, JsonNode reported) {
        if (name.equals("id") || name.equals("type") || name.equals("@context")) {
            return;
        }
        String builtIn = BUILT_INS.get(name);
        if (builtIn != null && reported.isTextual()) {
            put(builtIn, NgsiLdAttribute.plain("DateTime", reported));
            if (name.equals("deletedAt")) {
                put("alterationType", NgsiLdAttribute.plain("Text", JsonNodeFactory.instance.textNode("entityDelete")));
            }
        } else if (NgsiLdAttribute.isMultiInstance(reported)) {
            Map<String, JsonNode> newest = new LinkedHashMap<>();
            for (JsonNode instance : reported) {
                newest.merge(instance.path("datasetId").asText(""), instance, NgsiLdEntity::newer);
            }
            newest.forEach(
                    (dataset, instance) -> put(dataset.isEmpty() ? name : name + ":" + dataset, observed(instance)));
        } else {
            put(name, observed(reported));
        }
    }

    /** Returns the instance with the later observation, or else modification; the second if there is no time. */
    private static JsonNode newer(JsonNode first, JsonNode second) {
        return timeOf(second).isBefore(timeOf(first)) ? first : second;
    }

    private static Instant timeOf(JsonNode instance) {
        return Stream.of("observedAt", "modifiedAt")
                .flatMap(name -> Instants.ofText(instance.path(name).asText()).stream())
                .findFirst()
                .orElse(Instant.MIN);
    }

    /** Puts an attribute. Built-ins may come first or last, and never replace an attribute of the thing. */
    private void put(String name, ObjectNode attribute) {
        boolean builtIn = BUILT_INS.containsValue(name);
        if (!builtIn || !normalized.has(name)) {
            normalized.set(name, attribute);
        }
    }

    private ObjectNode observed(JsonNode reported) {
        JsonNode at = reported.path("observedAt");
        Optional<Instant> time = at.isTextual() ? Instants.of(at) : Optional.empty();
        modified.merge(
                time.isPresent(),
                Instants.ofText(reported.path("modifiedAt").asText()).orElse(Instant.MIN),
                BinaryOperator.maxBy(Comparator.naturalOrder()));
        if (time.isPresent()
                && newestObservation
                        .flatMap(Instants::ofText)
                        .filter(time.get()::isBefore)
                        .isEmpty()) {
            newestObservation = Optional.of(at.textValue());
        }
        return NgsiLdAttribute.read(reported);
    }

    private void addTime() {
        Instant observed = modified.getOrDefault(true, Instant.MIN);
        boolean isEarlier = !observed.equals(Instant.MIN)
                && modified.getOrDefault(false, Instant.MIN).isAfter(observed);
        boolean isTimed =
                DEVICE_TIMES.stream().anyMatch(name -> Instants.of(value(name)).isPresent());
        if (!isEarlier && !isTimed && value("TimeInstant").asText("").isBlank()) {
            newestObservation.ifPresent(time -> normalized.set(
                    "TimeInstant", NgsiLdAttribute.plain("DateTime", JsonNodeFactory.instance.textNode(time))));
        }
    }

    private JsonNode value(String attribute) {
        return normalized.path(attribute).path("value");
    }

    /** Returns the features of a collection or the elements of a list; empty if it is neither. */
    static Optional<List<JsonNode>> members(JsonNode data) {
        if (data.isArray()) {
            return Optional.of(data.valueStream().toList());
        }
        return data.path("features").isArray()
                ? Optional.of(data.get("features")
                        .valueStream()
                        .map(NgsiLdEntity::ofFeature)
                        .toList())
                : Optional.empty();
    }
}
