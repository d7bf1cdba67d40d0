package io.furrow.simulators.fiware;

import java.time.Instant;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A subscription and what became of its notifications. Its fields are guarded by its own monitor. */
final class Subscription {
    private final String id;
    private final PathFilter paths;
    private SubscriptionDefinition definition;
    private boolean active;
    private long timesSent;
    private int failsCounter;
    private Optional<Instant> lastNotification = Optional.empty();
    private Optional<Instant> lastSuccess = Optional.empty();
    private int lastSuccessCode;
    private Optional<Instant> lastFailure = Optional.empty();
    private String lastFailureReason = "";

    Subscription(String id, PathFilter paths, SubscriptionDefinition definition) {
        this.id = id;
        this.paths = paths;
        this.definition = definition;
        this.active = definition.limits().active();
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
            failsCounter = active ? 0 : failsCounter;
        }
    }

    /** Whether the change is to be notified now; counts it as sent if so. */
    synchronized boolean triggeredBy(Change change, Instant now) {
        boolean triggered = status(now).equals("active")
                && paths.matches(change.after().scope().servicePath())
                && definition.subject().covers(change)
                && !throttled(now);
        if (triggered) {
            timesSent++;
            lastNotification = Optional.of(now);
        }
        return triggered;
    }

    synchronized void succeeded(Instant now, int statusCode) {
        lastSuccess = Optional.of(now);
        lastSuccessCode = statusCode;
        failsCounter = 0;
    }

    synchronized void failed(Instant now, String reason) {
        lastFailure = Optional.of(now);
        lastFailureReason = reason;
        failsCounter++;
        if (definition.limits().maxFails().filter(limit -> failsCounter > limit).isPresent()) {
            active = false;
        }
    }

    synchronized ObjectNode json(Instant now) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("id", id);
        json.setAll(definition.json().deepCopy());
        json.put("status", status(now));
        ObjectNode notification = (ObjectNode) json.get("notification");
        if (timesSent > 0) {
            notification.put("timesSent", timesSent);
        }
        lastNotification.ifPresent(time -> notification.put("lastNotification", NgsiTime.format(time)));
        lastSuccess.ifPresent(
                time -> notification.put("lastSuccess", NgsiTime.format(time)).put("lastSuccessCode", lastSuccessCode));
        lastFailure.ifPresent(time ->
                notification.put("lastFailure", NgsiTime.format(time)).put("lastFailureReason", lastFailureReason));
        if (failsCounter > 0) {
            notification.put("failsCounter", failsCounter);
        }
        return json;
    }

    private String status(Instant now) {
        if (definition.limits().expires().filter(end -> !now.isBefore(end)).isPresent()) {
            return "expired";
        }
        return active ? "active" : "inactive";
    }

    private boolean throttled(Instant now) {
        return lastNotification
                .filter(last -> now.isBefore(last.plus(definition.limits().throttling())))
                .isPresent();
    }
}
