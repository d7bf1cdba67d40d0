package io.furrow.bench.evaluation;

import java.net.URI;
import java.util.List;
import java.util.Map;
import java.util.stream.StreamSupport;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.option.CommandException;
import io.furrow.launcher.process.RestClient;
import io.furrow.simulators.device.FleetSettings;

/**
 * Copies the NGSI source's subscription, so that the context broker notifies of each change several times; removes the copies at the
 * end.
 */
final class SubscriptionCopies implements AutoCloseable {
    private static final String DESCRIPTION = "copy for an evaluation";

    private final RestClient rest = new RestClient();
    private final URI subscriptions;
    private final Map<String, String> tenant;
    private int copies = 1;

    SubscriptionCopies(FleetSettings fiware) {
        this.subscriptions = fiware.contextBroker().resolve("/v2/subscriptions");
        this.tenant = Map.of("fiware-service", fiware.fiwareService());
    }

    /** Subscribes until there is the desired number of subscriptions. */
    void ensure(int desired) {
        for (; copies < desired; copies++) {
            add();
        }
    }

    private void add() {
        ObjectNode copy = all().stream()
                .filter(each -> !isCopy(each))
                .findFirst()
                .orElseThrow(() -> new CommandException(
                        "The context broker has nothing at %s; start the NGSI source first".formatted(subscriptions)))
                .deepCopy();
        copy.put("description", DESCRIPTION).retain("description", "subject", "notification");
        ((ObjectNode) copy.get("notification"))
                .remove(List.of(
                        "timesSent lastNotification lastSuccess lastSuccessCode lastFailure lastFailureReason failsCounter"
                                .split(" ")));
        RestClient.Answer answer = rest.send("POST", subscriptions, tenant, copy);
        if (!answer.isSuccess()) {
            throw new CommandException("The context broker refused a copy of the subscription: " + answer.body());
        }
    }

    private List<ObjectNode> all() {
        JsonNode all =
                rest.get(URI.create(subscriptions + "?limit=1000"), tenant).body();
        return StreamSupport.stream(all.spliterator(), false)
                .map(ObjectNode.class::cast)
                .toList();
    }

    private static boolean isCopy(JsonNode subscription) {
        return subscription.path("description").asText().equals(DESCRIPTION);
    }

    @Override
    public void close() {
        if (copies > 1) {
            all().stream()
                    .filter(SubscriptionCopies::isCopy)
                    .forEach(copy -> rest.delete(
                            URI.create(subscriptions + "/" + copy.path("id").asText()), tenant));
        }
    }
}
