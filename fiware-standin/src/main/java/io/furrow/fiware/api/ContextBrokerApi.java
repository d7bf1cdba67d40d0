package io.furrow.fiware.api;

import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.Call;
import io.furrow.fiware.LoopbackServer;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.Notifier;

/** Routes {@code /version} and {@code /v2}, with Orion's status codes and error bodies. */
public final class ContextBrokerApi implements LoopbackServer.Endpoint {
    private static final Set<String> WITH_BODY = Set.of("POST", "PUT", "PATCH");

    private final EntityResource entities;
    private final AttributeResource attributes;
    private final BatchResource batches;
    private final SubscriptionResource subscriptions;
    private final TypeResource types;
    private final RegistrationResource registrations;

    public ContextBrokerApi(ContextBroker broker, Notifier notifier) {
        this.entities = new EntityResource(broker);
        this.attributes = new AttributeResource(broker);
        this.batches = new BatchResource(broker);
        this.subscriptions = new SubscriptionResource(broker, notifier);
        this.types = new TypeResource(broker);
        this.registrations = new RegistrationResource(broker);
    }

    @Override
    public Reply answer(Call call) throws NgsiError {
        if (WITH_BODY.contains(call.method()) && call.body().length == 0) {
            throw NgsiError.noBody();
        }
        List<String> path = call.path();
        if (path.equals(List.of("version"))) {
            return Reply.ok(version());
        }
        if (path.isEmpty() || !path.get(0).equals("v2")) {
            throw NgsiError.noService();
        }
        if (path.size() == 1) {
            return Reply.ok(links());
        }
        return switch (path.get(1)) {
            case "entities" -> path.size() <= 3 ? entities.answer(call) : attributes.answer(call);
            case "subscriptions" -> subscriptions.answer(call);
            case "op" -> batches.answer(call);
            case "types" -> types.answer(call);
            case "registrations" -> registrations.answer(call);
            default -> throw NgsiError.noService();
        };
    }

    @Override
    public Reply describe(NgsiError error) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("error", error.error());
        return Reply.json(error.status(), json.put("description", error.getMessage()));
    }

    /** In Orion's format, for checks of clients. */
    private static ObjectNode version() {
        ObjectNode version = JsonNodeFactory.instance.objectNode();
        version.putObject("orion").put("version", "4.7.0-furrow-stand-in");
        return version;
    }

    private static ObjectNode links() {
        return JsonNodeFactory.instance
                .objectNode()
                .put("entities_url", "/v2/entities")
                .put("types_url", "/v2/types")
                .put("subscriptions_url", "/v2/subscriptions")
                .put("registrations_url", "/v2/registrations");
    }
}
