package io.furrow.fiware.api;

import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.EntityUpdate.Action;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;

/** Updates of {@code /v2/entities/<id>/attrs} and deletions of {@code …/attrs/<name>}. */
final class AttributeResource {
    private static final int ATTRS = 4;
    private static final int ONE = 5;
    private static final int UNPROCESSABLE = 422;

    private final ContextBroker broker;

    AttributeResource(ContextBroker broker) {
        this.broker = broker;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        if (!call.path().get(3).equals("attrs") || call.path().size() > ONE) {
            throw NgsiError.noService();
        }
        if (call.path().size() == ONE) {
            return delete(call);
        }
        return switch (call.method()) {
            case "POST" -> update(call, Action.APPEND);
            case "PATCH" -> update(call, Action.UPDATE);
            case "PUT" -> update(call, Action.REPLACE);
            default -> throw NgsiError.badMethod();
        };
    }

    private NgsiResponse delete(NgsiRequest call) throws NgsiError {
        if (!call.method().equals("DELETE")) {
            throw NgsiError.badMethod();
        }
        try {
            AttributeInput any = AttributeInput.valueOnly(JsonNodeFactory.instance.nullNode());
            return change(call, Map.of(call.path().get(ATTRS), any), Action.DELETE);
        } catch (NgsiError e) {
            throw e.status() == UNPROCESSABLE ? NgsiError.noAttribute() : e;
        }
    }

    private NgsiResponse update(NgsiRequest call, Action action) throws NgsiError {
        JsonNode json = call.json();
        boolean clears = action == Action.REPLACE && json.isObject() && json.isEmpty();
        return change(
                call, clears ? Map.of() : new EntityBodyReader(call.option("keyValues")).attributes(json), action);
    }

    private NgsiResponse change(NgsiRequest call, Map<String, AttributeInput> attributes, Action action)
            throws NgsiError {
        String id = call.path().get(2);
        SyntaxRules.checkEntity(id, call.parameter("type"));
        EntityUpdate update = new EntityUpdate(id, call.parameter("type"), attributes);
        broker.update(call.scope(), update, action, call.option("forcedUpdate"), call.correlator());
        return NgsiResponse.noContent();
    }
}
