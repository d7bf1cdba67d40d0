package io.furrow.connect.sink;

import java.math.BigDecimal;
import java.nio.ByteBuffer;
import java.time.Instant;
import java.time.LocalTime;
import java.time.ZoneOffset;
import java.util.Base64;
import java.util.Collection;
import java.util.Date;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.common.utils.Utils;
import org.apache.kafka.connect.data.Field;
import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.data.Time;
import org.apache.kafka.connect.data.Timestamp;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A struct as a normalized entity: {@code id} and {@code type} are fields, every other field that is not null is an attribute.
 * A field that is itself a struct of {@code value} and perhaps {@code type} and {@code metadata} is such an attribute already.
 *
 * <table>
 * <caption>Types</caption>
 * <tr><td>Timestamp, Date</td><td>{@code DateTime}, ISO 8601 in UTC, a Date without time</td></tr>
 * <tr><td>Time</td><td>{@code Text}, ISO 8601</td></tr>
 * <tr><td>Decimal, integers, floats</td><td>{@code Number}, digit for digit</td></tr>
 * <tr><td>bytes</td><td>{@code Text}, base64</td></tr>
 * <tr><td>struct, map, array</td><td>{@code StructuredValue}, a null in an array stays</td></tr>
 * </table>
 */
final class StructReader {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private StructReader() {}

    static ObjectNode entity(Struct struct) throws UnreadableException {
        ObjectNode entity = NODES.objectNode();
        for (Field field : struct.schema().fields()) {
            Object value = struct.get(field);
            if (value == null) {
                continue;
            }
            if (field.name().equals("id") || field.name().equals("type")) {
                entity.put(field.name(), value.toString());
            } else {
                entity.set(field.name(), attribute(field.schema(), value));
            }
        }
        String schemaName = struct.schema().name();
        if (!entity.has("type") && schemaName != null) {
            entity.put("type", schemaName.substring(schemaName.lastIndexOf('.') + 1));
        }
        return entity;
    }

    private static ObjectNode attribute(Schema schema, Object value) throws UnreadableException {
        if (value instanceof Struct struct && isAttribute(struct.schema())) {
            Schema inner = struct.schema().field("value").schema();
            Object innerValue = struct.get("value");
            ObjectNode attribute = plain(inner, innerValue);
            Optional.ofNullable(member(struct, "type")).ifPresent(type -> attribute.put("type", type.toString()));
            if (member(struct, "metadata") instanceof Struct metadata) {
                for (Field item : metadata.schema().fields()) {
                    if (metadata.get(item) != null) {
                        ((ObjectNode) attribute.get("metadata"))
                                .set(item.name(), withoutMetadata(attribute(item.schema(), metadata.get(item))));
                    }
                }
            }
            return attribute;
        }
        return plain(schema, value);
    }

    private static Object member(Struct struct, String name) {
        return struct.schema().field(name) == null ? null : struct.get(name);
    }

    private static ObjectNode withoutMetadata(ObjectNode attribute) {
        attribute.remove("metadata");
        return attribute;
    }

    private static boolean isAttribute(Schema schema) {
        return schema.field("value") != null
                && schema.fields().stream()
                        .allMatch(field -> field.name().equals("value")
                                || field.name().equals("type") && field.schema().type() == Schema.Type.STRING
                                || field.name().equals("metadata")
                                        && field.schema().type() == Schema.Type.STRUCT);
    }

    private static ObjectNode plain(Schema schema, Object value) throws UnreadableException {
        JsonNode json = json(value, schema);
        ObjectNode attribute = NODES.objectNode().put("type", type(schema, json));
        attribute.set("value", json);
        attribute.putObject("metadata");
        return attribute;
    }

    private static String type(Schema schema, JsonNode json) {
        boolean isDate = org.apache.kafka.connect.data.Date.LOGICAL_NAME.equals(schema.name())
                || Timestamp.LOGICAL_NAME.equals(schema.name());
        if (isDate) {
            return "DateTime";
        }
        if (json.path("type").isTextual() && json.path("coordinates").isArray()) {
            return "geo:json";
        }
        return switch (json.getNodeType()) {
            case STRING -> "Text";
            case NUMBER -> "Number";
            case BOOLEAN -> "Boolean";
            case NULL -> "None";
            default -> "StructuredValue";
        };
    }

    private static JsonNode json(Object value, Schema schema) throws UnreadableException {
        if (value == null) {
            return NODES.nullNode();
        } else if (value instanceof Date date) {
            return NODES.textNode(text(date, schema == null ? null : schema.name()));
        } else if (value instanceof BigDecimal number) {
            return NODES.numberNode(number);
        } else if (value instanceof Float || value instanceof Double) {
            return finite((Number) value);
        } else if (value instanceof Number number) {
            return NODES.numberNode(number.longValue());
        } else if (value instanceof Boolean truth) {
            return NODES.booleanNode(truth);
        } else if (value instanceof byte[] bytes) {
            return NODES.textNode(Base64.getEncoder().encodeToString(bytes));
        } else if (value instanceof ByteBuffer buffer) {
            return NODES.textNode(Base64.getEncoder().encodeToString(Utils.toArray(buffer)));
        }
        return container(value, schema);
    }

    private static JsonNode container(Object value, Schema schema) throws UnreadableException {
        if (value instanceof Struct struct) {
            ObjectNode object = NODES.objectNode();
            for (Field field : struct.schema().fields()) {
                if (struct.get(field) != null) {
                    object.set(field.name(), json(struct.get(field), field.schema()));
                }
            }
            return object;
        } else if (value instanceof Map<?, ?> map) {
            ObjectNode object = NODES.objectNode();
            for (Map.Entry<?, ?> entry : map.entrySet()) {
                object.set(String.valueOf(entry.getKey()), json(entry.getValue(), valueSchema(schema)));
            }
            return object;
        } else if (value instanceof Collection<?> elements) {
            ArrayNode array = NODES.arrayNode();
            for (Object element : elements) {
                array.add(json(element, valueSchema(schema)));
            }
            return array;
        }
        return NODES.textNode(value.toString());
    }

    private static Schema valueSchema(Schema schema) {
        boolean has = schema != null && (schema.type() == Schema.Type.ARRAY || schema.type() == Schema.Type.MAP);
        return has ? schema.valueSchema() : null;
    }

    private static JsonNode finite(Number number) throws UnreadableException {
        if (!Double.isFinite(number.doubleValue())) {
            throw new UnreadableException(Reason.NOT_AN_ENTITY, "JSON has no number " + number);
        }
        // The shortest digits that are this float: 0.1f is 0.1, not 0.10000000149011612.
        return NODES.numberNode(new BigDecimal(number.toString()));
    }

    private static String text(Date date, String logicalName) {
        Instant instant = date.toInstant();
        if (org.apache.kafka.connect.data.Date.LOGICAL_NAME.equals(logicalName)) {
            return instant.atZone(ZoneOffset.UTC).toLocalDate().toString();
        }
        return Time.LOGICAL_NAME.equals(logicalName)
                ? LocalTime.ofInstant(instant, ZoneOffset.UTC).toString()
                : instant.toString();
    }
}
