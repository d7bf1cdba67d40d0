package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An entity in NGSI-v2 normalized form: {@code {id, type, <attribute>: {type, value, metadata}}}.
 *
 * @param json the normalized form; owned by the entity, not to be changed by readers
 */
public record Entity(ObjectNode json) {
    /** When the context broker changed an entity, or as metadata one of its attributes. */
    public static final String MODIFIED = "dateModified";

    /** Members that the context broker adds to an entity on request, which are not attributes of the thing itself. */
    public static final Set<String> BUILT_INS =
            Set.of("dateCreated", MODIFIED, "dateExpires", "servicePath", "alterationType", "deletedAt");

    private static final Set<String> NOT_ATTRIBUTES = Set.of("id", "type");
    private static final Pattern COMMAND_TYPE = Pattern.compile("command(Status|Result)?");
    private static final Pattern COMMAND_OF_ROBOTS = Pattern.compile("cmd(_(status|info))?");
    /** Words of the IoT Agent for a command without a result. */
    private static final Set<String> PROGRESS = Set.of("PENDING", "SENT", "DELIVERED", "EXPIRED");

    public Entity {
        Objects.requireNonNull(json);
    }

    /**
     * Reads an entity in normalized form.
     *
     * @throws UnreadableException with {@link Reason#NOT_AN_ENTITY}
     */
    public static Entity of(JsonNode json) throws UnreadableException {
        return NgsiV2Representation.NORMALIZED.read(json);
    }

    /**
     * Reads an entity in any form: NGSI-v2 normalized or key-values, or NGSI-LD, detected by its shape.
     *
     * @throws UnreadableException with {@link Reason#NOT_AN_ENTITY}
     */
    public static Entity ofAnyForm(JsonNode json) throws UnreadableException {
        return NgsiLdEntity.looksLike(json)
                ? NgsiLdEntity.read(json)
                : NgsiV2Representation.of(json).read(json);
    }

    /** Reads an entity from the UTF-8 JSON of its normalized form, the value on all {@code data.*} topics. */
    public static Entity parse(byte[] normalized) throws UnreadableException {
        return of(NgsiJson.read(normalized));
    }

    /** Reads only the desired attributes, for readers that need few of many; rejects the same input. */
    public static Entity parse(byte[] normalized, Set<String> desired) throws UnreadableException {
        return PartialEntityReader.read(normalized, desired);
    }

    /** Returns a builder of an entity without attributes. */
    public static EntityBuilder builder(String id, String type) {
        return new EntityBuilder(id, type);
    }

    public String id() {
        return json.get("id").textValue();
    }

    /** Returns the type; {@code Thing}, the context broker's default, if none was reported. */
    public String type() {
        JsonNode type = json.get("type");
        return type == null ? "Thing" : type.textValue();
    }

    /** Returns the value of an attribute; empty if it is missing or null. */
    public Optional<JsonNode> value(String attribute) {
        JsonNode value = json.path(attribute).path("value");
        return value.isMissingNode() || value.isNull() || NOT_ATTRIBUTES.contains(attribute)
                ? Optional.empty()
                : Optional.of(value);
    }

    /** Returns the value of an attribute as text; empty if it is missing, blank or not text. */
    public Optional<String> text(String attribute) {
        return value(attribute)
                .filter(JsonNode::isTextual)
                .map(JsonNode::textValue)
                .filter(text -> !text.isBlank());
    }

    /** Returns the value of an attribute as a name, of a mission for instance: its text, or the digits of a whole number. */
    public Optional<String> name(String attribute) {
        return text(attribute).or(() -> number(attribute).flatMap(Numbers::digits));
    }

    /** Returns the value of an attribute as a finite number, also if it was sent as text; otherwise empty. */
    public Optional<Double> number(String attribute) {
        return value(attribute).flatMap(Numbers::finite);
    }

    /** Returns the attributes, including built-ins, in the reported order, as a new list. */
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
     * Returns whether an attribute is a command or its state, which others than the device write: not each {@code
     * engine_status} is. The dashboard's page follows the same rule, and its tests use the same table of cases.
     */
    public static boolean isOfCommand(String name, JsonNode attribute) {
        return COMMAND_TYPE.matcher(attribute.path("type").asText()).matches()
                || COMMAND_OF_ROBOTS.matcher(name).matches()
                || name.endsWith("_status")
                        && PROGRESS.contains(attribute.path("value").asText());
    }

    /**
     * Returns whether this reports the deletion of the entity: its last content with {@code alterationType} (and {@code
     * deletedAt} if the context broker reports the time).
     */
    public boolean isDeleted() {
        return text("alterationType").filter("entityDelete"::equals).isPresent();
    }

    /** Returns the entity as UTF-8 JSON. */
    public byte[] toBytes() {
        return NgsiJson.write(json);
    }
}
