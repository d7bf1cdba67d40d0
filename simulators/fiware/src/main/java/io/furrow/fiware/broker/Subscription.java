package io.furrow.fiware.broker;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicLong;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.PathFilter;

/** A subscription and the state of its notifications. Guarded by its own monitor. */
public final class Subscription {
    private final String id;
    private final PathFilter paths;
    private final AtomicLong revision;
    private SubscriptionDefinition definition;
    private boolean active;
    private DeliveryCounters delivery = DeliveryCounters.NONE;

    Subscription(String id, PathFilter paths, SubscriptionDefinition definition, AtomicLong revision) {
        this.id = id;
        this.paths = paths;
        this.revision = revision;
        this.definition = definition;
        this.active = definition.limits().active();
    }

    /** The inverse of {@link #state}. */
    public static Subscription restored(JsonNode state, AtomicLong revision) throws NgsiError {
        List<String> patterns = new ArrayList<>();
        state.required("paths").forEach(pattern -> patterns.add(pattern.asText()));
        Subscription subscription = new Subscription(
                state.required("id").asText(),
                new PathFilter(List.copyOf(patterns)),
                SubscriptionReader.read(state.required("definition")),
                revision);
        subscription.active = state.required("active").asBoolean();
        subscription.delivery = DeliveryCounters.shownIn(state.required("delivery"));
        return subscription;
    }

    public String id() {
        return id;
    }

    public PathFilter paths() {
        return paths;
    }

    public synchronized SubscriptionDefinition definition() {
        return definition;
    }

    /**
     * Replaces the definition and keeps the counters; one deactivated by failures is reactivated only by its status.
     */
    public synchronized void redefine(SubscriptionDefinition other, boolean statusGiven) {
        definition = other;
        if (statusGiven) {
            active = other.limits().active();
            delivery = active ? delivery.forgiven() : delivery;
        }
        revision.incrementAndGet();
    }

    /** Whether to notify of the change now; counts it as sent if so. */
    synchronized boolean triggeredBy(EntityChange change, Instant now) {
        boolean triggered = status(now).equals("active")
                && paths.matches(change.after().scope().servicePath())
                && definition.subject().covers(change)
                && !throttled(now);
        if (triggered) {
            delivery = delivery.begun(now);
            revision.incrementAndGet();
        }
        return triggered;
    }

    synchronized void succeeded(Instant now, int statusCode) {
        delivery = delivery.succeeded(now, statusCode);
        revision.incrementAndGet();
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
        revision.incrementAndGet();
    }

    /** JSON for {@code GET}. */
    public synchronized ObjectNode json(Instant now) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("id", id);
        json.setAll(definition.json().deepCopy());
        json.put("status", status(now));
        delivery.showIn((ObjectNode) json.get("notification"));
        return json;
    }

    /** The complete state, for {@link #restored}. */
    public synchronized ObjectNode state() {
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
