package io.furrow.connect.repair;

import java.time.Duration;
import java.time.Instant;
import java.util.Optional;
import java.util.function.Function;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Detects a restart of the context broker from the {@code uptime} that Orion reports at {@code GET /version}. A restart
 * loses the notifications that wait in its memory, and the counters of begun notifications. A broker that does not
 * report its uptime, or not to this client, counts as never restarted.
 */
record BrokerUptime(Function<BrokerRequest, Outcome> broker, FiwareScope scope) {
    private static final Pattern UPTIME = Pattern.compile("(\\d{1,6}) d, (\\d{1,2}) h, (\\d{1,2}) m, (\\d{1,2}) s");
    /** Uptime and time of the answer are truncated to seconds. */
    private static final Duration BLUR = Duration.ofSeconds(1);

    /**
     * Whether the broker was, or may have been, started after a time.
     *
     * @param now by the clock of the context broker
     */
    boolean isYoungerThan(Instant then, Instant now) {
        return uptime().map(now::minus)
                .filter(start -> !start.isBefore(then.minus(BLUR)))
                .isPresent();
    }

    private Optional<Duration> uptime() {
        if (!(broker.apply(BrokerRequest.get(scope, "/version")) instanceof Outcome.Done done)) {
            return Optional.empty();
        }
        try {
            Matcher uptime = UPTIME.matcher(done.json().at("/orion/uptime").asText());
            return uptime.matches()
                    ? Optional.of(Duration.ofDays(Long.parseLong(uptime.group(1)))
                            .plusHours(Long.parseLong(uptime.group(2)))
                            .plusMinutes(Long.parseLong(uptime.group(3)))
                            .plusSeconds(Long.parseLong(uptime.group(4))))
                    : Optional.empty();
        } catch (UnreadableException e) {
            return Optional.empty();
        }
    }
}
