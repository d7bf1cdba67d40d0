package io.furrow.fiware.api;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;

/** Reads entities and attributes of requests, normalized or {@code keyValues}; refuses what Orion refuses. */
final class EntityBodyReader {
    private static final Set<String> ATTRIBUTE_FIELDS = Set.of("type", "value", "metadata");
    private static final Set<String> NOT_ATTRIBUTES = Set.of("id", "type");
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final boolean keyValues;

    EntityBodyReader(boolean keyValues) {
        this.keyValues = keyValues;
    }

    EntityUpdate entity(JsonNode json) throws NgsiError {
        object(json);
        String id = text(json, "id")
                .orElseThrow(() -> NgsiError.badRequest("entity id length: 0, min length supported: 1"));
        Optional<String> type = text(json, "type");
        SyntaxRules.checkEntity(id, type);
        return new EntityUpdate(id, type, members(json));
    }

    /** The attributes of a request whose URL names the entity. */
    Map<String, AttributeInput> attributes(JsonNode json) throws NgsiError {
        object(json);
        if (json.has("id") || json.has("type")) {
            throw NgsiError.badRequest("entity " + (json.has("id") ? "id" : "type") + " specified in payload");
        }
        return members(json);
    }

    private Map<String, AttributeInput> members(JsonNode json) throws NgsiError {
        Map<String, AttributeInput> attributes = new LinkedHashMap<>();
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (!NOT_ATTRIBUTES.contains(member.getKey())) {
                SyntaxRules.checkAttributeName(member.getKey());
                attributes.put(member.getKey(), attribute(member.getValue()));
            }
        }
        return attributes;
    }

    AttributeInput attribute(JsonNode json) throws NgsiError {
        AttributeInput attribute =
                keyValues ? AttributeInput.valueOnly(AttributeInput.canonical(json)) : normalized(json);
        SyntaxRules.check(attribute);
        return attribute;
    }

    private static AttributeInput normalized(JsonNode json) throws NgsiError {
        if (!json.isObject()) {
            throw NgsiError.badRequest("attribute must be a JSON object, unless keyValues option is used");
        }
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (!ATTRIBUTE_FIELDS.contains(member.getKey())) {
                throw NgsiError.badRequest("unrecognized property for context attribute");
            }
        }
        return new AttributeInput(text(json, "type"), value(json), metadata(json.path("metadata")));
    }

    private static Optional<ObjectNode> metadata(JsonNode json) throws NgsiError {
        if (json.isMissingNode()) {
            return Optional.empty();
        }
        if (!json.isObject()) {
            throw NgsiError.badRequest("metadata must be a JSON object");
        }
        ObjectNode all = NODES.objectNode();
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (!member.getValue().isObject()) {
                throw NgsiError.badRequest("metadata item must be a JSON object");
            }
            JsonNode value = value(member.getValue());
            String type = text(member.getValue(), "type").orElseGet(() -> AttributeInput.defaultType(value));
            all.putObject(member.getKey()).put("type", type).set("value", value);
        }
        return Optional.of(all);
    }

    private static JsonNode value(JsonNode holder) {
        JsonNode value = holder.path("value");
        return value.isMissingNode() ? NODES.nullNode() : AttributeInput.canonical(value);
    }

    private static void object(JsonNode json) throws NgsiError {
        if (!json.isObject()) {
            throw NgsiError.badRequest("not a JSON object");
        }
        if (json.isEmpty()) {
            throw NgsiError.badRequest("empty payload");
        }
    }

    private static Optional<String> text(JsonNode json, String field) throws NgsiError {
        JsonNode value = json.path(field);
        if (value.isMissingNode()) {
            return Optional.empty();
        }
        if (!value.isTextual()) {
            throw NgsiError.badRequest("Invalid JSON type for " + field);
        }
        return Optional.of(value.textValue());
    }
}
