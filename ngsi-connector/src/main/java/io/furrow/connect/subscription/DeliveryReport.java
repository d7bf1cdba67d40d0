package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What the context broker says became of the notifications of a subscription.
 *
 * @param timesSent notifications begun, failed ones among them
 * @param failsInARow refused connections and answers that did not come in time, since the last success
 * @param lastFailure to the second
 * @param lastSuccess to the second
 */
public record DeliveryReport(
        long timesSent, long failsInARow, Optional<Instant> lastFailure, Optional<Instant> lastSuccess) {
    /** Of a subscription that has sent nothing yet. */
    public static final DeliveryReport NOTHING_SENT = new DeliveryReport(0, 0, Optional.empty(), Optional.empty());

    static DeliveryReport of(JsonNode subscription) {
        JsonNode notification = subscription.path("notification");
        return new DeliveryReport(
                notification.path("timesSent").asLong(),
                notification.path("failsCounter").asLong(),
                BrokerTime.parse(notification.path("lastFailure").asText()),
                BrokerTime.parse(notification.path("lastSuccess").asText()));
    }
}
