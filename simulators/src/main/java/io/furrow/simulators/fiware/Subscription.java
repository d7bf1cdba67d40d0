package io.furrow.simulators.fiware;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A subscription and what became of its notifications. Its fields are guarded by its own monitor. */
final class Subscription {
    private final String id;
    private final PathFilter paths;
    private final Revision revision;
    private SubscriptionDefinition definition;
    private boolean active;
    private Delivery delivery = Delivery.NONE;

    /** @param revision advanced by every change of it */
    Subscription(String id, PathFilter paths, SubscriptionDefinition definition, Revision revision) {
        this.id = id;
        this.paths = paths;
        this.revision = revision;
        this.definition = definition;
        this.active = definition.limits().active();
    }

    /** The inverse of {@link #state}. */
    static Subscription restored(JsonNode state, Revision revision) throws NgsiError {
        List<String> patterns = new ArrayList<>();
        state.required("paths").forEach(pattern -> patterns.add(pattern.asText()));
        Subscription subscription = new Subscription(
                state.required("id").asText(),
                new PathFilter(List.copyOf(patterns)),
                SubscriptionReader.read(state.required("definition")),
                revision);
        subscription.active = state.required("active").asBoolean();
        subscription.delivery = Delivery.shownIn(state.required("delivery"));
        return subscription;
    }

    String id() {
        return id;
    }

    PathFilter paths() {
        return paths;
    }

    synchronized SubscriptionDefinition definition() {
        return definition;
    }

    /** Another definition, the same counters; a subscription that failures had set inactive comes back only by its status. */
    synchronized void redefine(SubscriptionDefinition other, boolean statusGiven) {
        definition = other;
        if (statusGiven) {
            active = other.limits().active();
            delivery = active ? delivery.forgiven() : delivery;
        }
        revision.advance();
    }

    /** Whether the change is to be notified now; counts it as sent if so. */
    synchronized boolean triggeredBy(Change change, Instant now) {
        boolean triggered = status(now).equals("active")
                && paths.matches(change.after().scope().servicePath())
                && definition.subject().covers(change)
                && !throttled(now);
        if (triggered) {
            delivery = delivery.begun(now);
            revision.advance();
        }
        return triggered;
    }

    synchronized void succeeded(Instant now, int statusCode) {
        delivery = delivery.succeeded(now, statusCode);
        revision.advance();
    }

    synchronized void failed(Instant now, String reason) {
        delivery = delivery.failed(now, reason);
        if (definition
                .limits()
                .maxFails()
                .filter(limit -> delivery.failsInARow() > limit)
                .isPresent()) {
            active = false;
        }
        revision.advance();
    }

    /** As {@code GET} shows it. */
    synchronized ObjectNode json(Instant now) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("id", id);
        json.setAll(definition.json().deepCopy());
        json.put("status", status(now));
        delivery.showIn((ObjectNode) json.get("notification"));
        return json;
    }

    /** All of it, for {@link #restored}. */
    synchronized ObjectNode state() {
        ObjectNode state = JsonNodeFactory.instance.objectNode().put("id", id).put("active", active);
        paths.patterns().forEach(state.putArray("paths")::add);
        state.set("definition", definition.requested());
        delivery.showIn(state.putObject("delivery"));
        return state;
    }

    private String status(Instant now) {
        if (definition.limits().expires().filter(end -> !now.isBefore(end)).isPresent()) {
            return "expired";
        }
        return active ? "active" : "inactive";
    }

    private boolean throttled(Instant now) {
        return delivery.lastNotification()
                .filter(last -> now.isBefore(last.plus(definition.limits().throttling())))
                .isPresent();
    }
}
