package io.furrow.fiware.api;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.EntityUpdate.Action;
import io.furrow.fiware.broker.Rendering;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.model.event.FiwareScope;

/**
 * {@code POST /v2/op/query}, which finds entities by id and optional type, and {@code POST /v2/op/update}, which updates the
 * entities of a batch one after the other.
 */
final class BatchResource {
    private final ContextBroker broker;

    BatchResource(ContextBroker broker) {
        this.broker = broker;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        String operation = call.path().size() == 3 ? call.path().get(2) : "";
        if (!operation.equals("update") && !operation.equals("query")) {
            throw NgsiError.noService();
        }
        if (!call.method().equals("POST")) {
            throw NgsiError.badMethod();
        }
        return operation.equals("query") ? query(call) : update(call);
    }

    private NgsiResponse query(NgsiRequest call) throws NgsiError {
        JsonNode body = call.json();
        if (body.has("expression") || !body.has("entities")) {
            throw NgsiError.unsupported("a query by anything but entities");
        }
        Set<StoredEntity> found = new LinkedHashSet<>();
        for (JsonNode named : body.get("entities")) {
            if (!named.path("id").isTextual()) {
                throw NgsiError.unsupported("a query of entities without an id");
            }
            String id = named.get("id").textValue();
            Optional<String> type = Optional.ofNullable(named.path("type").textValue());
            SyntaxRules.checkEntity(id, type);
            found.addAll(broker.tenant(call.service()).find(call.paths(), id, type));
        }
        Rendering shown =
                new Rendering(texts(body.path("attrs")), texts(body.path("metadata")), Rendering.Format.NORMALIZED);
        ArrayNode entities = JsonNodeFactory.instance.arrayNode();
        found.stream().skip(call.offset()).limit(call.limit()).map(shown::of).forEach(entities::add);
        return NgsiResponse.ok(entities);
    }

    private static List<String> texts(JsonNode list) {
        List<String> texts = new ArrayList<>();
        list.forEach(text -> texts.add(text.asText()));
        return texts;
    }

    private NgsiResponse update(NgsiRequest call) throws NgsiError {
        JsonNode json = call.json();
        Action action = Action.of(json.path("actionType").asText());
        EntityBodyReader reader = new EntityBodyReader(call.option("keyValues"));
        List<EntityUpdate> updates = new ArrayList<>();
        for (JsonNode entity : json.path("entities")) {
            updates.add(reader.entity(entity));
        }
        if (updates.isEmpty()) {
            throw NgsiError.badRequest("empty entities vector");
        }
        apply(call, action, updates);
        return NgsiResponse.noContent();
    }

    /** A refused entity does not stop the others. */
    private void apply(NgsiRequest call, Action action, List<EntityUpdate> updates) throws NgsiError {
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

    private void apply(NgsiRequest call, FiwareScope scope, Action action, EntityUpdate update) throws NgsiError {
        boolean existing = !broker.tenant(scope.service())
                .find(scope.servicePath(), update.id(), update.type())
                .isEmpty();
        if (!existing && action != Action.APPEND) {
            throw NgsiError.noEntity(update.label());
        }
        if (action == Action.DELETE && update.attributes().isEmpty()) {
            broker.delete(scope, update.id(), update.type(), call.correlator());
        } else if (!existing) {
            broker.upsert(scope, update, call.option("forcedUpdate"), call.correlator());
        } else {
            broker.update(scope, update, action, call.option("forcedUpdate"), call.correlator());
        }
    }
}
