package io.furrow.model.ngsi;

import java.util.Collection;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Builds an {@link Entity} attribute by attribute, with the attribute types that WeLASER's programs know. */
public final class EntityBuilder {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final ObjectNode json = NODES.objectNode();

    EntityBuilder(String id, String type) {
        json.put("id", id).put("type", type);
    }

    /** An attribute of type {@code String}. */
    public EntityBuilder text(String name, String value) {
        return attribute(name, "String", NODES.textNode(value));
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
            throw new IllegalArgumentException("'" + name + "' is no name for an attribute");
        }
        ObjectNode attribute = NODES.objectNode().put("type", type);
        attribute.set("value", value);
        attribute.set("metadata", NODES.objectNode());
        json.set(name, attribute);
        return this;
    }

    public Entity build() {
        return new Entity(json);
    }
}
