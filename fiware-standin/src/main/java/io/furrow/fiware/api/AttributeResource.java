package io.furrow.fiware.api;

import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.EntityUpdate.Action;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * {@code /v2/entities/<id>/attrs}, {@code …/attrs/<name>} and {@code …/attrs/<name>/value}. Treats PATCH of a single
 * attribute like PUT, where Orion answers 405.
 */
final class AttributeResource {
    private static final int ATTRS = 4;
    private static final int ONE = 5;
    private static final int UNPROCESSABLE = 422;

    private final ContextBroker broker;

    AttributeResource(ContextBroker broker) {
        this.broker = broker;
    }

    Reply answer(Call call) throws NgsiError {
        if (!call.path().get(3).equals("attrs")) {
            throw NgsiError.noService();
        }
        if (call.path().size() == ATTRS) {
            return all(call);
        }
        if (call.path().size() == ONE) {
            return one(call);
        }
        if (call.path().size() == ONE + 1 && call.path().get(ONE).equals("value")) {
            return value(call);
        }
        throw NgsiError.noService();
    }

    private Reply all(Call call) throws NgsiError {
        return switch (call.method()) {
            case "GET" -> Reply.ok(attributes(call));
            case "POST" -> update(call, call.option("append") ? Action.APPEND_STRICT : Action.APPEND);
            case "PATCH" -> update(call, Action.UPDATE);
            case "PUT" -> update(call, Action.REPLACE);
            default -> throw NgsiError.badMethod();
        };
    }

    private Reply one(Call call) throws NgsiError {
        switch (call.method()) {
            case "GET":
                return Reply.ok(attribute(call));
            case "PUT", "PATCH":
                return put(call, new EntityReader(false).attribute(call.json()));
            case "DELETE":
                return change(call, AttributeInput.valueOnly(JsonNodeFactory.instance.nullNode()), Action.DELETE);
            default:
                throw NgsiError.badMethod();
        }
    }

    private Reply value(Call call) throws NgsiError {
        return switch (call.method()) {
            case "GET" -> Reply.ok(attribute(call).get("value"));
            case "PUT" -> put(call, new EntityReader(true).attribute(given(call)));
            default -> throw NgsiError.badMethod();
        };
    }

    private Reply put(Call call, AttributeInput input) throws NgsiError {
        return change(call, input, Action.UPDATE);
    }

    /** For an attribute of the path, answers 404 for the attribute itself. */
    private Reply change(Call call, AttributeInput input, Action action) throws NgsiError {
        try {
            return change(call, Map.of(call.path().get(ATTRS), input), action);
        } catch (NgsiError e) {
            throw e.status() == UNPROCESSABLE ? NgsiError.noAttribute() : e;
        }
    }

    private Reply update(Call call, Action action) throws NgsiError {
        JsonNode json = call.json();
        boolean clears = action == Action.REPLACE && json.isObject() && json.isEmpty();
        return change(call, clears ? Map.of() : new EntityReader(call.option("keyValues")).attributes(json), action);
    }

    private Reply change(Call call, Map<String, AttributeInput> attributes, Action action) throws NgsiError {
        String id = call.path().get(2);
        SyntaxRules.checkEntity(id, call.parameter("type"));
        EntityUpdate update = new EntityUpdate(id, call.parameter("type"), attributes);
        broker.update(call.scope(), update, action, EntityResource.options(call), call.correlator());
        return Reply.noContent();
    }

    private JsonNode attributes(Call call) throws NgsiError {
        JsonNode entity = EntityQuery.rendering(call).of(EntityResource.find(broker, call));
        return entity instanceof ObjectNode object ? object.without(Set.of("id", "type")) : entity;
    }

    private JsonNode attribute(Call call) throws NgsiError {
        StoredEntity entity = EntityResource.find(broker, call);
        String name = call.path().get(ATTRS);
        if (!entity.attributes().containsKey(name)) {
            throw NgsiError.noAttribute();
        }
        return EntityQuery.rendering(call).of(entity).get(name);
    }

    /** Reads a value: JSON of any kind, or as {@code text/plain} a quoted text, a number, true, false or null. */
    private static JsonNode given(Call call) throws NgsiError {
        call.requireMediaType("application/json", "text/plain");
        try {
            return NgsiJson.read(call.body());
        } catch (UnreadableException e) {
            throw NgsiError.badRequest(
                    "attribute value type not recognized: " + new String(call.body(), StandardCharsets.UTF_8));
        }
    }
}
