package io.furrow.fiware.broker;

import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Delivery counters of a subscription.
 *
 * @param timesSent notifications started
 * @param failsInARow since the last success
 * @param lastSuccessCode HTTP status, 0 without a success
 */
record Delivery(
        long timesSent,
        int failsInARow,
        Optional<Instant> lastNotification,
        Optional<Instant> lastSuccess,
        int lastSuccessCode,
        Optional<Instant> lastFailure,
        String lastFailureReason) {
    static final Delivery NONE = new Delivery(0, 0, Optional.empty(), Optional.empty(), 0, Optional.empty(), "");

    Delivery begun(Instant now) {
        return new Delivery(
                timesSent + 1,
                failsInARow,
                Optional.of(now),
                lastSuccess,
                lastSuccessCode,
                lastFailure,
                lastFailureReason);
    }

    Delivery succeeded(Instant now, int statusCode) {
        return new Delivery(
                timesSent, 0, lastNotification, Optional.of(now), statusCode, lastFailure, lastFailureReason);
    }

    Delivery failed(Instant now, String reason) {
        return new Delivery(
                timesSent, failsInARow + 1, lastNotification, lastSuccess, lastSuccessCode, Optional.of(now), reason);
    }

    Delivery forgiven() {
        return new Delivery(
                timesSent, 0, lastNotification, lastSuccess, lastSuccessCode, lastFailure, lastFailureReason);
    }

    /**
     * Adds the members that {@code GET} shows in {@code notification}; times are in whole seconds, and missing without
     * an event.
     */
    void showIn(ObjectNode notification) {
        if (timesSent > 0) {
            notification.put("timesSent", timesSent);
        }
        lastNotification.ifPresent(time -> notification.put("lastNotification", seconds(time)));
        lastSuccess.ifPresent(
                time -> notification.put("lastSuccess", seconds(time)).put("lastSuccessCode", lastSuccessCode));
        lastFailure.ifPresent(
                time -> notification.put("lastFailure", seconds(time)).put("lastFailureReason", lastFailureReason));
        if (failsInARow > 0) {
            notification.put("failsCounter", failsInARow);
        }
    }

    /** Orion stores these in whole seconds. */
    private static String seconds(Instant time) {
        return NgsiTime.format(time.truncatedTo(ChronoUnit.SECONDS));
    }

    /** Reads what {@link #showIn} wrote. */
    static Delivery shownIn(JsonNode notification) {
        return new Delivery(
                notification.path("timesSent").asLong(),
                notification.path("failsCounter").asInt(),
                NgsiTime.parse(notification.path("lastNotification").asText()),
                NgsiTime.parse(notification.path("lastSuccess").asText()),
                notification.path("lastSuccessCode").asInt(),
                NgsiTime.parse(notification.path("lastFailure").asText()),
                notification.path("lastFailureReason").asText());
    }
}
