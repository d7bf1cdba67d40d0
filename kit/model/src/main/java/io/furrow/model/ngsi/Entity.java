package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * One entity in NGSI-v2 normalized form: {@code {id, type, <attribute>: {type, value, metadata}}}.
 *
 * @param json the normalized form; owned by the entity, not to be changed by readers
 */
public record Entity(ObjectNode json) {
    /** When the context broker changed an entity, and as metadata an attribute of it. */
    public static final String MODIFIED = "dateModified";

    /** What the context broker adds to an entity on request; no attributes of the thing itself. */
    public static final Set<String> BUILT_INS =
            Set.of("dateCreated", MODIFIED, "dateExpires", "servicePath", "alterationType", "deletedAt");

    private static final Set<String> NOT_ATTRIBUTES = Set.of("id", "type");

    public Entity {
        Objects.requireNonNull(json);
    }

    /**
     * An entity from a JSON object that should be one in normalized form.
     *
     * @throws UnreadableException with {@link Reason#NOT_AN_ENTITY}
     */
    public static Entity of(JsonNode json) throws UnreadableException {
        return NgsiV2Representation.NORMALIZED.read(json);
    }

    /**
     * An entity from a JSON object in whatever form: NGSI-v2 normalized or key-values, or NGSI-LD, detected by its shape.
     *
     * @throws UnreadableException with {@link Reason#NOT_AN_ENTITY}
     */
    public static Entity ofAnyForm(JsonNode json) throws UnreadableException {
        return NgsiLdEntity.looksLike(json)
                ? NgsiLdEntity.read(json)
                : NgsiV2Representation.of(json).read(json);
    }

    /** An entity from the UTF-8 JSON of its normalized form, which is what every {@code data.*} topic carries. */
    public static Entity parse(byte[] normalized) throws UnreadableException {
        return of(NgsiJson.read(normalized));
    }

    /**
     * The same with the wanted attributes only, for readers that need few of many: an image that nobody asked for is passed
     * over. What is refused is the same.
     */
    public static Entity parse(byte[] normalized, Set<String> desired) throws UnreadableException {
        return PartialEntityReader.read(normalized, desired);
    }

    /** A new entity with the given id and type and no attributes. */
    public static EntityBuilder builder(String id, String type) {
        return new EntityBuilder(id, type);
    }

    public String id() {
        return json.get("id").textValue();
    }

    /** The type; {@code Thing}, as the context broker has it, where none was reported. */
    public String type() {
        JsonNode type = json.get("type");
        return type == null ? "Thing" : type.textValue();
    }

    /** The value of an attribute; empty if the entity has no such attribute or its value is null. */
    public Optional<JsonNode> value(String attribute) {
        JsonNode value = json.path(attribute).path("value");
        return value.isMissingNode() || value.isNull() || NOT_ATTRIBUTES.contains(attribute)
                ? Optional.empty()
                : Optional.of(value);
    }

    /** The value of an attribute as text; empty if it is missing, blank or no text. */
    public Optional<String> text(String attribute) {
        return value(attribute)
                .filter(JsonNode::isTextual)
                .map(JsonNode::textValue)
                .filter(text -> !text.isBlank());
    }

    /** The value of an attribute as a finite number, also where a device sent it as text; else empty. */
    public Optional<Double> number(String attribute) {
        return value(attribute).flatMap(Numbers::finite);
    }

    /** The attributes, built-ins included, in the order in which they were reported; a list of the caller's own. */
    public List<Map.Entry<String, JsonNode>> attributes() {
        List<Map.Entry<String, JsonNode>> attributes = new ArrayList<>(json.size());
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (!NOT_ATTRIBUTES.contains(member.getKey())) {
                attributes.add(member);
            }
        }
        return attributes;
    }

    /**
     * Whether this is the report that the entity was deleted: what it held last, with {@code alterationType} (and
     * {@code deletedAt} if the context broker reports the time).
     */
    public boolean isDeleted() {
        return text("alterationType").filter("entityDelete"::equals).isPresent();
    }

    /** UTF-8 JSON. */
    public byte[] toBytes() {
        return NgsiJson.write(json);
    }
}
