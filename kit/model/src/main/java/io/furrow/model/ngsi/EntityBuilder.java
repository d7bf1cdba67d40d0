package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Builds an {@link Entity} attribute by attribute, with the attribute types that WeLASER's programs know. What is only to be
 * written need not become an entity first: see {@link #toBytes}.
 */
public final class EntityBuilder {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final String id;
    private final String type;
    private final Map<String, Attribute> attributes = new LinkedHashMap<>();

    /** What an attribute is in normalized form; it has no metadata. */
    public record Attribute(String name, String type, JsonNode value) {}

    EntityBuilder(String id, String type) {
        this.id = id;
        this.type = type;
    }

    /** An attribute of type {@code String}. The context broker rejects a value with one of {@code < > " ' = ; ( )}. */
    public EntityBuilder text(String name, String value) {
        return attribute(name, "String", NODES.textNode(value));
    }

    /**
     * An attribute of type {@code TextUnrestricted}, of which the context broker accepts any text: names that people give.
     *
     * @param value null for none
     */
    public EntityBuilder freeText(String name, String value) {
        return attribute(name, "TextUnrestricted", value == null ? NODES.nullNode() : NODES.textNode(value));
    }

    /**
     * An attribute of type {@code Float}.
     *
     * @throws IllegalArgumentException if the value is not finite: JSON has no form for it
     */
    public EntityBuilder number(String name, double value) {
        if (!Double.isFinite(value)) {
            throw new IllegalArgumentException("attribute " + name + " is not finite: " + value);
        }
        return attribute(name, "Float", NODES.numberNode(value));
    }

    /** An attribute of type {@code Integer}; times are epoch milliseconds. */
    public EntityBuilder integer(String name, long value) {
        return attribute(name, "Integer", NODES.numberNode(value));
    }

    /** An attribute of type {@code Boolean}. */
    public EntityBuilder bool(String name, boolean value) {
        return attribute(name, "Boolean", NODES.booleanNode(value));
    }

    /** An attribute of type {@code StructuredValue}: a list of texts. */
    public EntityBuilder texts(String name, Collection<String> values) {
        var array = NODES.arrayNode();
        values.forEach(array::add);
        return attribute(name, "StructuredValue", array);
    }

    /**
     * An attribute of any type and value.
     *
     * @throws IllegalArgumentException if the name is {@code id} or {@code type}, which are no attributes
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

    /** In the order in which they were given. */
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

    /** UTF-8 JSON, byte by byte that of the entity. */
    public byte[] toBytes() {
        return NgsiJson.write(this);
    }
}
