package io.furrow.fiware.broker;

import java.math.BigDecimal;
import java.time.Instant;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;

/**
 * An attribute of a request.
 *
 * @param type empty for that of the stored attribute, or a default by the value of a new one
 * @param metadata empty for that of the stored attribute
 */
public record AttributeInput(Optional<String> type, JsonNode value, Optional<ObjectNode> metadata) {
    public static AttributeInput of(String type, JsonNode value) {
        return new AttributeInput(Optional.of(type), value, Optional.empty());
    }

    public static AttributeInput valueOnly(JsonNode value) {
        return new AttributeInput(Optional.empty(), value, Optional.empty());
    }

    public AttributeInput withMetadata(String name, ObjectNode entry) {
        ObjectNode all = metadata.map(ObjectNode::deepCopy).orElseGet(JsonNodeFactory.instance::objectNode);
        all.set(name, entry);
        return new AttributeInput(type, value, Optional.of(all));
    }

    public StoredAttribute created(Instant now) throws NgsiError {
        return attribute(
                type.orElseGet(() -> defaultType(value)),
                metadata.orElseGet(JsonNodeFactory.instance::objectNode),
                now,
                now);
    }

    /** Merges with the stored attribute; metadata not in the request stay. */
    public StoredAttribute merged(StoredAttribute before, Instant now) throws NgsiError {
        ObjectNode merged = before.metadata().deepCopy();
        metadata.ifPresent(merged::setAll);
        return attribute(type.orElse(before.type()), merged, before.created(), now);
    }

    private StoredAttribute attribute(
            String resolvedType, ObjectNode resolvedMetadata, Instant created, Instant modified) throws NgsiError {
        return new StoredAttribute(
                resolvedType,
                dated(resolvedType, value, "attribute value"),
                datedAll(resolvedMetadata),
                created,
                modified);
    }

    private static ObjectNode datedAll(ObjectNode metadata) throws NgsiError {
        ObjectNode all = JsonNodeFactory.instance.objectNode();
        for (Map.Entry<String, JsonNode> entry : metadata.properties()) {
            String type = entry.getValue().path("type").asText();
            ObjectNode dated = JsonNodeFactory.instance.objectNode().put("type", type);
            dated.set("value", dated(type, entry.getValue().get("value"), "metadata value"));
            all.set(entry.getKey(), dated);
        }
        return all;
    }

    /** The context broker stores a date as a number and returns it in its own format. */
    static JsonNode dated(String type, JsonNode value, String what) throws NgsiError {
        if (value.isNull() || !type.equals("DateTime") && !type.equals("ISO8601")) {
            return value;
        }
        Instant time = (value.isTextual() ? NgsiTime.parse(value.textValue()) : Optional.<Instant>empty())
                .orElseThrow(() -> NgsiError.badRequest("date has invalid format in " + what));
        return JsonNodeFactory.instance.textNode(NgsiTime.format(time));
    }

    /** NGSI-v2, "Partial Representations". */
    public static String defaultType(JsonNode value) {
        return switch (value.getNodeType()) {
            case STRING -> "Text";
            case NUMBER -> "Number";
            case BOOLEAN -> "Boolean";
            case OBJECT, ARRAY -> "StructuredValue";
            default -> "None";
        };
    }

    /** Numbers in the context broker's format: 18.0 and 18 are the same value, written 18. */
    public static JsonNode canonical(JsonNode value) {
        if (value.isBigDecimal()) {
            BigDecimal number = value.decimalValue().stripTrailingZeros();
            return number.scale() > 0 || number.precision() - number.scale() > 18
                    ? JsonNodeFactory.instance.numberNode(number)
                    : JsonNodeFactory.instance.numberNode(number.longValueExact());
        }
        if (value instanceof ObjectNode object) {
            object.properties().forEach(member -> member.setValue(canonical(member.getValue())));
        } else if (value instanceof ArrayNode array) {
            for (int i = 0; i < array.size(); i++) {
                array.set(i, canonical(array.get(i)));
            }
        } else if (value.isInt()) {
            return JsonNodeFactory.instance.numberNode(value.longValue());
        }
        return value;
    }
}
