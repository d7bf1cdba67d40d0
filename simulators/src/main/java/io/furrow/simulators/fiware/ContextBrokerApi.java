package io.furrow.simulators.fiware;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** {@code /version} and {@code /v2}: which resource answers what, with Orion's status codes and error bodies. */
final class ContextBrokerApi implements LoopbackServer.Endpoint {
    private final EntityResource entities;
    private final AttributeResource attributes;
    private final BatchResource batches;
    private final SubscriptionResource subscriptions;

    ContextBrokerApi(ContextBroker broker, Notifier notifier) {
        this.entities = new EntityResource(broker);
        this.attributes = new AttributeResource(broker);
        this.batches = new BatchResource(broker);
        this.subscriptions = new SubscriptionResource(broker, notifier);
    }

    @Override
    public Reply answer(Call call) throws NgsiError {
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
            default -> throw NgsiError.noService();
        };
    }

    @Override
    public JsonNode describe(NgsiError error) {
        return JsonNodeFactory.instance.objectNode().put("error", error.error()).put("description", error.getMessage());
    }

    /** Orion's own form, so that a client's check works; the version says what it is. */
    private static ObjectNode version() {
        ObjectNode version = JsonNodeFactory.instance.objectNode();
        version.putObject("orion").put("version", "4.7.0-furrow-stand-in");
        return version;
    }

    private static ObjectNode links() {
        return JsonNodeFactory.instance
                .objectNode()
                .put("entities_url", "/v2/entities")
                .put("subscriptions_url", "/v2/subscriptions");
    }
}
