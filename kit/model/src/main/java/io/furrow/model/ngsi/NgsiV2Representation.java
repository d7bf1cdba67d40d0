package io.furrow.model.ngsi;

import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** The two NGSI-v2 representations of an entity, with their conversion to the normalized one. */
enum NgsiV2Representation {
    /** {@code {"id": …, "type": …, "speed": {"type": "Number", "value": 3, "metadata": {}}}}. */
    NORMALIZED {
        @Override
        ObjectNode attribute(String name, JsonNode reported) throws UnreadableException {
            if (!reported.isObject() || !reported.has("value")) {
                throw noAttribute(name);
            }
            if (isNormal((ObjectNode) reported)) {
                return (ObjectNode) reported;
            }
            return normal(reported.path("type"), reported.get("value"), reported.path("metadata"));
        }
    },
    /** {@code {"id": …, "type": …, "speed": 3}}. */
    KEY_VALUES {
        @Override
        ObjectNode attribute(String name, JsonNode reported) {
            return normal(JsonNodeFactory.instance.missingNode(), reported, JsonNodeFactory.instance.missingNode());
        }
    };

    private static final Set<String> ATTRIBUTE_MEMBERS = Set.of("type", "value", "metadata");

    static UnreadableException noAttribute(String name) {
        return new UnreadableException(
                Reason.NOT_AN_ENTITY, "attribute '" + name + "' is not an object with a member 'value'");
    }

    abstract ObjectNode attribute(String name, JsonNode reported) throws UnreadableException;

    /** Detects the representation of an entity: normalized if every attribute has that shape. */
    static NgsiV2Representation of(JsonNode entity) {
        for (Map.Entry<String, JsonNode> member : entity.properties()) {
            boolean plain = member.getKey().equals("id") || member.getKey().equals("type");
            if (!plain && !looksNormalized(member.getValue())) {
                return KEY_VALUES;
            }
        }
        return NORMALIZED;
    }

    /**
     * Returns whether a value has the shape of a normalized attribute; a device's own object, for instance {@code
     * {"value": 3, "unit": "C"}}, has another member.
     */
    private static boolean looksNormalized(JsonNode attribute) {
        return attribute.has("value")
                && attribute.properties().stream().map(Map.Entry::getKey).allMatch(ATTRIBUTE_MEMBERS::contains);
    }

    Entity read(JsonNode reported) throws UnreadableException {
        if (!reported.isObject()) {
            throw new UnreadableException(Reason.NOT_AN_ENTITY, "an entity is a JSON object, not " + kind(reported));
        }
        JsonNode id = reported.path("id");
        Reason.NOT_AN_ENTITY.refuseIf(
                !id.isTextual() || id.textValue().isBlank(), "the entity has no member 'id' with a text");
        if (reported.has("type") && !reported.get("type").isTextual()) {
            throw new UnreadableException(
                    Reason.NOT_AN_ENTITY, "the type of entity '" + id.textValue() + "' is not text");
        }
        ObjectNode normalized = JsonNodeFactory.instance.objectNode();
        for (Map.Entry<String, JsonNode> member : reported.properties()) {
            boolean plain = member.getKey().equals("id") || member.getKey().equals("type");
            normalized.set(member.getKey(), plain ? member.getValue() : attribute(member.getKey(), member.getValue()));
        }
        EntityLimits.check(normalized);
        return new Entity(normalized);
    }

    private static boolean isNormal(ObjectNode attribute) {
        return attribute.size() == 3
                && attribute.path("type").isTextual()
                && attribute.path("metadata").isObject();
    }

    private static ObjectNode normal(JsonNode type, JsonNode value, JsonNode metadata) {
        ObjectNode attribute = JsonNodeFactory.instance.objectNode();
        attribute.put("type", type.isTextual() ? type.textValue() : typeOf(value));
        attribute.set("value", value);
        attribute.set("metadata", metadata.isObject() ? metadata : JsonNodeFactory.instance.objectNode());
        return attribute;
    }

    /** Returns the context broker's type of an attribute without one (NGSI-v2, "Partial Representations"). */
    static String typeOf(JsonNode value) {
        return switch (value.getNodeType()) {
            case STRING -> "Text";
            case NUMBER -> "Number";
            case BOOLEAN -> "Boolean";
            case OBJECT -> isGeoJson(value) ? "geo:json" : "StructuredValue";
            case ARRAY -> "StructuredValue";
            default -> "None";
        };
    }

    static boolean isGeoJson(JsonNode value) {
        return value.path("type").isTextual() && value.path("coordinates").isArray();
    }

    private static String kind(JsonNode node) {
        return node.getNodeType().name().toLowerCase(java.util.Locale.ROOT);
    }
}
