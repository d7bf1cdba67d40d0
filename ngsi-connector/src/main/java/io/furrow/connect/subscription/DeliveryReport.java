package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.Optional;
import java.util.OptionalLong;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What the context broker says became of the notifications of a subscription.
 *
 * @param timesSent notifications begun, failed ones among them; 0 where it says nothing, empty where it is no number
 * @param failsInARow refused connections and answers that did not come in time, since the last success
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
                BrokerTime.parse(notification.path("lastFailure").asText()),
                BrokerTime.parse(notification.path("lastSuccess").asText()));
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
