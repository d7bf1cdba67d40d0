package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Builds an {@link Entity} with attribute types of the WeLASER platform; {@link #toBytes} builds no tree. */
public final class EntityBuilder {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final String id;
    private final String type;
    private final Map<String, Attribute> attributes = new LinkedHashMap<>();

    /** An attribute in normalized form, without metadata. */
    public record Attribute(String name, String type, JsonNode value) {}

    EntityBuilder(String id, String type) {
        this.id = id;
        this.type = type;
    }

    /**
     * Adds an attribute of type {@code String}. The context broker rejects values with one of {@code < > " ' = ; ( )}.
     */
    public EntityBuilder text(String name, String value) {
        return attribute(name, "String", NODES.textNode(value));
    }

    /**
     * Adds an attribute of type {@code TextUnrestricted}, for which the context broker accepts any text, such as names
     * from users.
     *
     * @param value null for none
     */
    public EntityBuilder freeText(String name, String value) {
        return attribute(name, "TextUnrestricted", value == null ? NODES.nullNode() : NODES.textNode(value));
    }

    /**
     * Adds an attribute of type {@code Float}.
     *
     * @throws IllegalArgumentException if the value is not finite, which JSON cannot express
     */
    public EntityBuilder number(String name, double value) {
        if (!Double.isFinite(value)) {
            throw new IllegalArgumentException("attribute " + name + " is not finite: " + value);
        }
        return attribute(name, "Float", NODES.numberNode(value));
    }

    /** Adds an attribute of type {@code Integer}; times are epoch milliseconds. */
    public EntityBuilder integer(String name, long value) {
        return attribute(name, "Integer", NODES.numberNode(value));
    }

    /** Adds an attribute of type {@code Boolean}. */
    public EntityBuilder bool(String name, boolean value) {
        return attribute(name, "Boolean", NODES.booleanNode(value));
    }

    /** Adds an attribute of type {@code StructuredValue} with a list of texts. */
    public EntityBuilder texts(String name, Collection<String> values) {
        var array = NODES.arrayNode();
        values.forEach(array::add);
        return attribute(name, "StructuredValue", array);
    }

    /**
     * Adds an attribute of any type and value.
     *
     * @throws IllegalArgumentException if the name is {@code id} or {@code type}, which are not attributes
     */
    public EntityBuilder attribute(String name, String type, JsonNode value) {
        if (name.equals("id") || name.equals("type")) {
            throw new IllegalArgumentException("'" + name + "' is not a name for an attribute");
        }
        attributes.put(name, new Attribute(name, type, value));
        return this;
    }

    public String id() {
        return id;
    }

    public String type() {
        return type;
    }

    /** Returns the attributes in the order of their addition. */
    public List<Attribute> attributes() {
        return new ArrayList<>(attributes.values());
    }

    public Entity build() {
        ObjectNode json = NODES.objectNode().put("id", id).put("type", type);
        for (Attribute each : attributes.values()) {
            ObjectNode attribute = json.putObject(each.name).put("type", each.type);
            attribute.set("value", each.value);
            attribute.putObject("metadata");
        }
        return new Entity(json);
    }

    /** Returns the same UTF-8 JSON as the built entity. */
    public byte[] toBytes() {
        return NgsiJson.write(this);
    }
}
