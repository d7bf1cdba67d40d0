package io.furrow.fiware.api;

import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.Notifier;
import io.furrow.fiware.http.LoopbackServer;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;

/** Routes {@code /version} and {@code /v2}, with Orion's status codes and error bodies. */
public final class NgsiV2Api implements LoopbackServer.Endpoint {
    private static final Set<String> WITH_BODY = Set.of("POST", "PUT", "PATCH");
    /** {@code skipForwarding} has no effect: there is no provider to forward to. */
    private static final Set<String> OPTIONS = Set.of("count", "forcedUpdate", "keyValues", "skipForwarding", "upsert");

    private final EntityResource entities;
    private final AttributeResource attributes;
    private final BatchResource batches;
    private final SubscriptionResource subscriptions;

    public NgsiV2Api(ContextBroker broker, Notifier notifier) {
        this.entities = new EntityResource(broker);
        this.attributes = new AttributeResource(broker);
        this.batches = new BatchResource(broker);
        this.subscriptions = new SubscriptionResource(broker, notifier);
    }

    @Override
    public NgsiResponse answer(NgsiRequest call) throws NgsiError {
        if (WITH_BODY.contains(call.method()) && call.body().length == 0) {
            throw NgsiError.noBody();
        }
        List<String> path = call.path();
        if (path.equals(List.of("version"))) {
            return NgsiResponse.ok(version());
        }
        if (path.size() < 2 || !path.get(0).equals("v2")) {
            throw NgsiError.noService();
        }
        for (String option : call.list("options")) {
            if (!OPTIONS.contains(option)) {
                throw NgsiError.unsupported("option '" + option + "'");
            }
        }
        return switch (path.get(1)) {
            case "entities" -> path.size() <= 3 ? entities.answer(call) : attributes.answer(call);
            case "subscriptions" -> subscriptions.answer(call);
            case "op" -> batches.answer(call);
            default -> throw NgsiError.noService();
        };
    }

    @Override
    public NgsiResponse describe(NgsiError error) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("error", error.error());
        return NgsiResponse.json(error.status(), json.put("description", error.getMessage()));
    }

    /** In Orion's format, for version checks of clients. */
    private static ObjectNode version() {
        ObjectNode version = JsonNodeFactory.instance.objectNode();
        version.putObject("orion").put("version", "4.7.0-furrow-stand-in");
        return version;
    }
}
