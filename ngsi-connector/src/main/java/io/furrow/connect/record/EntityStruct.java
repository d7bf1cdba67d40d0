package io.furrow.connect.record;

import java.nio.charset.StandardCharsets;
import java.util.LinkedHashMap;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.data.SchemaBuilder;
import org.apache.kafka.connect.data.Struct;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * An entity as a struct of one schema, whatever its type and attributes, so that a topic has one schema forever:
 *
 * <pre>
 * io.furrow.ngsi.Entity 1     id, type, attributes: map of name to
 * io.furrow.ngsi.Attribute 1  type, value (JSON text, digit for digit), textValue, numberValue, booleanValue, metadata: map of name to
 * io.furrow.ngsi.Metadata 1   type, value (JSON text)
 * </pre>
 *
 * The typed values are null unless the JSON value is of that type; a number is the nearest that 64 bits hold. Names and types
 * are such that JSON Schema, Avro and Protobuf have them. Fields may be added with a default and another version, never renamed.
 */
public final class EntityStruct {
    static final Schema METADATA = SchemaBuilder.struct()
            .name("io.furrow.ngsi.Metadata")
            .version(1)
            .field("type", Schema.OPTIONAL_STRING_SCHEMA)
            .field("value", Schema.STRING_SCHEMA)
            .build();

    static final Schema ATTRIBUTE = SchemaBuilder.struct()
            .name("io.furrow.ngsi.Attribute")
            .version(1)
            .field("type", Schema.OPTIONAL_STRING_SCHEMA)
            .field("value", Schema.STRING_SCHEMA)
            .field("textValue", Schema.OPTIONAL_STRING_SCHEMA)
            .field("numberValue", Schema.OPTIONAL_FLOAT64_SCHEMA)
            .field("booleanValue", Schema.OPTIONAL_BOOLEAN_SCHEMA)
            .field("metadata", SchemaBuilder.map(Schema.STRING_SCHEMA, METADATA).build())
            .build();

    public static final Schema ENTITY = SchemaBuilder.struct()
            .name("io.furrow.ngsi.Entity")
            .version(1)
            .field("id", Schema.STRING_SCHEMA)
            .field("type", Schema.STRING_SCHEMA)
            .field(
                    "attributes",
                    SchemaBuilder.map(Schema.STRING_SCHEMA, ATTRIBUTE).build())
            .build();

    private EntityStruct() {}

    /** Whether a struct of this schema is an entity, even if a transform removed fields. */
    public static boolean isOf(Schema schema) {
        return ENTITY.name().equals(schema.name()) && schema.field("attributes") != null;
    }

    public static Struct of(Entity entity) {
        Map<String, Struct> attributes = new LinkedHashMap<>();
        entity.attributes().forEach(each -> attributes.put(each.getKey(), attribute(each.getValue())));
        return new Struct(ENTITY)
                .put("id", entity.id())
                .put("type", entity.type())
                .put("attributes", attributes);
    }

    private static Struct attribute(JsonNode attribute) {
        JsonNode value = attribute.path("value");
        Map<String, Struct> metadata = new LinkedHashMap<>();
        attribute
                .path("metadata")
                .properties()
                .forEach(item -> metadata.put(item.getKey(), typed(METADATA, item.getValue())));
        Struct struct = typed(ATTRIBUTE, attribute).put("metadata", metadata);
        if (value.isTextual()) {
            struct.put("textValue", value.textValue());
        } else if (value.isBoolean()) {
            struct.put("booleanValue", value.booleanValue());
        } else if (value.isNumber() && Double.isFinite(value.doubleValue())) {
            struct.put("numberValue", value.doubleValue());
        }
        return struct;
    }

    private static Struct typed(Schema schema, JsonNode of) {
        JsonNode value = of.path("value");
        return new Struct(schema)
                .put("type", of.path("type").textValue())
                .put("value", value.isMissingNode() ? "null" : text(value));
    }

    private static String text(JsonNode value) {
        return new String(NgsiJson.write(value), StandardCharsets.UTF_8);
    }

    /**
     * The entity as normalized JSON, without null and missing values.
     *
     * @throws UnreadableException if a value is not JSON
     */
    public static ObjectNode json(Struct struct) throws UnreadableException {
        ObjectNode entity = JsonNodeFactory.instance.objectNode();
        for (String name : new String[] {"id", "type"}) {
            if (member(struct, name) instanceof String text) {
                entity.put(name, text);
            }
        }
        for (Map.Entry<?, ?> each : map(struct, "attributes").entrySet()) {
            Struct attribute = (Struct) each.getValue();
            ObjectNode normalized = typed(attribute);
            ObjectNode metadata = normalized.putObject("metadata");
            for (Map.Entry<?, ?> item : map(attribute, "metadata").entrySet()) {
                metadata.set(item.getKey().toString(), typed((Struct) item.getValue()));
            }
            entity.set(each.getKey().toString(), normalized);
        }
        return entity;
    }

    private static ObjectNode typed(Struct struct) throws UnreadableException {
        ObjectNode typed = JsonNodeFactory.instance.objectNode();
        if (member(struct, "type") instanceof String type) {
            typed.put("type", type);
        }
        String value = String.valueOf(member(struct, "value"));
        typed.set("value", NgsiJson.read(value.getBytes(StandardCharsets.UTF_8)));
        return typed;
    }

    private static Map<?, ?> map(Struct struct, String name) {
        return member(struct, name) instanceof Map<?, ?> map ? map : Map.of();
    }

    private static Object member(Struct struct, String name) {
        return struct.schema().field(name) == null ? null : struct.get(name);
    }
}
