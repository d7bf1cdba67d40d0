package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.Optional;
import java.util.OptionalLong;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.time.Instants;

/**
 * The delivery statistics of a subscription, as reported by the context broker.
 *
 * @param timesSent notifications begun, including failed ones; 0 if not reported, empty if not a number
 * @param failsInARow refused connections and late answers since the last success
 * @param lastFailure to the second
 * @param lastSuccess to the second
 */
public record DeliveryReport(
        OptionalLong timesSent, long failsInARow, Optional<Instant> lastFailure, Optional<Instant> lastSuccess) {
    /** Of a subscription that has sent nothing yet. */
    public static final DeliveryReport NOTHING_SENT =
            new DeliveryReport(OptionalLong.of(0), 0, Optional.empty(), Optional.empty());

    static DeliveryReport of(JsonNode subscription) {
        JsonNode notification = subscription.path("notification");
        return new DeliveryReport(
                count(notification.path("timesSent")),
                notification.path("failsCounter").asLong(),
                Instants.ofText(notification.path("lastFailure").asText()),
                Instants.ofText(notification.path("lastSuccess").asText()));
    }

    private static OptionalLong count(JsonNode number) {
        if (number.isMissingNode()) {
            return OptionalLong.of(0);
        }
        return number.isIntegralNumber() && number.canConvertToLong() && number.longValue() >= 0
                ? OptionalLong.of(number.longValue())
                : OptionalLong.empty();
    }
}
