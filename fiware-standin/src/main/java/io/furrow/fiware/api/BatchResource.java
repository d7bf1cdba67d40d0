package io.furrow.fiware.api;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.EntityUpdate.Action;
import io.furrow.model.event.FiwareScope;

/** {@code POST /v2/op/query} and {@code POST /v2/op/update}; updates the entities of a batch one after the other. */
final class BatchResource {
    private final ContextBroker broker;

    BatchResource(ContextBroker broker) {
        this.broker = broker;
    }

    Reply answer(Call call) throws NgsiError {
        String operation = call.path().size() == 3 ? call.path().get(2) : "";
        if (!operation.equals("update") && !operation.equals("query")) {
            throw NgsiError.noService();
        }
        if (!call.method().equals("POST")) {
            throw NgsiError.badMethod();
        }
        if (operation.equals("query")) {
            return BatchQuery.reply(call, broker);
        }
        JsonNode json = call.json();
        Action action = Action.of(json.path("actionType").asText());
        EntityReader reader = new EntityReader(call.option("keyValues"));
        List<EntityUpdate> updates = new ArrayList<>();
        for (JsonNode entity : json.path("entities")) {
            updates.add(reader.entity(entity));
        }
        if (updates.isEmpty()) {
            throw NgsiError.badRequest("empty entities vector");
        }
        apply(call, action, updates);
        return Reply.noContent();
    }

    /** A refused entity does not stop the others. */
    private void apply(Call call, Action action, List<EntityUpdate> updates) throws NgsiError {
        FiwareScope scope = call.scope();
        List<NgsiError> refused = new ArrayList<>();
        for (EntityUpdate update : updates) {
            try {
                apply(call, scope, action, update);
            } catch (NgsiError e) {
                refused.add(e);
            }
        }
        if (refused.size() == updates.size()) {
            throw refused.get(0);
        }
        if (!refused.isEmpty()) {
            throw NgsiError.partial(String.join(
                    ", ", refused.stream().map(NgsiError::getMessage).toList()));
        }
    }

    private void apply(Call call, FiwareScope scope, Action action, EntityUpdate update) throws NgsiError {
        boolean known = !broker.tenant(scope.service())
                .find(scope.servicePath(), update.id(), update.type())
                .isEmpty();
        boolean appends = action == Action.APPEND || action == Action.APPEND_STRICT;
        if (!known && !appends) {
            throw NgsiError.noEntity(update);
        }
        if (action == Action.DELETE && update.attributes().isEmpty()) {
            broker.delete(scope, update.id(), update.type(), call.correlator());
        } else if (!known) {
            broker.upsert(scope, update, EntityResource.options(call), call.correlator());
        } else {
            broker.update(scope, update, action, EntityResource.options(call), call.correlator());
        }
    }
}
