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
record DeliveryCounters(
        long timesSent,
        int failsInARow,
        Optional<Instant> lastNotification,
        Optional<Instant> lastSuccess,
        int lastSuccessCode,
        Optional<Instant> lastFailure,
        String lastFailureReason) {
    static final DeliveryCounters NONE =
            new DeliveryCounters(0, 0, Optional.empty(), Optional.empty(), 0, Optional.empty(), "");

    DeliveryCounters begun(Instant now) {
        return new DeliveryCounters(
                timesSent + 1,
                failsInARow,
                Optional.of(now),
                lastSuccess,
                lastSuccessCode,
                lastFailure,
                lastFailureReason);
    }

    DeliveryCounters succeeded(Instant now, int statusCode) {
        return new DeliveryCounters(
                timesSent, 0, lastNotification, Optional.of(now), statusCode, lastFailure, lastFailureReason);
    }

    DeliveryCounters failed(Instant now, String reason) {
        return new DeliveryCounters(
                timesSent, failsInARow + 1, lastNotification, lastSuccess, lastSuccessCode, Optional.of(now), reason);
    }

    DeliveryCounters forgiven() {
        return new DeliveryCounters(
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
    static DeliveryCounters shownIn(JsonNode notification) {
        return new DeliveryCounters(
                notification.path("timesSent").asLong(),
                notification.path("failsCounter").asInt(),
                NgsiTime.parse(notification.path("lastNotification").asText()),
                NgsiTime.parse(notification.path("lastSuccess").asText()),
                notification.path("lastSuccessCode").asInt(),
                NgsiTime.parse(notification.path("lastFailure").asText()),
                notification.path("lastFailureReason").asText());
    }
}
