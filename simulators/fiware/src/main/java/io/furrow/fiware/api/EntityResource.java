package io.furrow.fiware.api;

import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;

/** {@code /v2/entities} and {@code /v2/entities/<id>}. */
final class EntityResource {
    private final ContextBroker broker;

    EntityResource(ContextBroker broker) {
        this.broker = broker;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        if (call.path().size() == 2) {
            return switch (call.method()) {
                case "GET" -> EntityQuery.of(call).reply(call, broker.tenant(call.service()));
                case "POST" -> create(call);
                default -> throw NgsiError.badMethod();
            };
        }
        return switch (call.method()) {
            case "GET" -> NgsiResponse.ok(EntityQuery.rendering(call).of(find(broker, call)));
            case "DELETE" -> delete(call);
            default -> throw NgsiError.badMethod();
        };
    }

    private NgsiResponse create(NgsiRequest call) throws NgsiError {
        JsonNode json = call.json();
        EntityUpdate entity = new EntityBodyReader(call.option("keyValues")).entity(json);
        String location =
                "/v2/entities/" + entity.id() + "?type=" + entity.type().orElse(EntityUpdate.DEFAULT_TYPE);
        if (call.option("upsert")) {
            boolean existing = !broker.tenant(call.service())
                    .find(call.scope().servicePath(), entity.id(), entity.type())
                    .isEmpty();
            broker.upsert(call.scope(), entity, call.option("forcedUpdate"), call.correlator());
            return existing ? NgsiResponse.noContent().with("Location", location) : NgsiResponse.created(location);
        }
        broker.create(call.scope(), entity, call.correlator());
        return NgsiResponse.created(location);
    }

    private NgsiResponse delete(NgsiRequest call) throws NgsiError {
        broker.delete(call.scope(), call.path().get(2), call.parameter("type"), call.correlator());
        return NgsiResponse.noContent();
    }

    static StoredEntity find(ContextBroker broker, NgsiRequest call) throws NgsiError {
        String id = call.path().get(2);
        Optional<String> type = call.parameter("type");
        SyntaxRules.checkEntity(id, type);
        return broker.get(call.service(), call.paths(), id, type);
    }
}
