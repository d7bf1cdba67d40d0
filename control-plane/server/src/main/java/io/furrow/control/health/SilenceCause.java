package io.furrow.control.health;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;
import io.furrow.model.text.Counts;

/**
 * The reason why a device does not report, according to its MQTT broker and the IoT Agent.
 *
 * @param code kind of cause
 * @param text part of a sentence about the device
 * @param time when it was last observed, epoch ms; 0 if it has no time
 * @param values names, numbers and times in the text, by name; times are epoch ms
 */
public record SilenceCause(String code, String text, long time, Map<String, String> values) {
    private static final String NO_MEASURE = "no-measure";
    /** Interval at which a shown cause is renewed if only its count has changed. */
    private static final Duration RENEWAL = Duration.ofMinutes(1);

    /**
     * Returns the best known reason why a device has not reported since it was requested.
     *
     * @param connection null if unknown
     * @param failure why it is not provisioned, as reported by the provisioner; null if not reported
     * @param from since when it is requested, epoch ms
     */
    public static SilenceCause ofUnheard(DeviceConnection connection, String failure, long from) {
        boolean registered = connection != null && Boolean.TRUE.equals(connection.registered());
        if (failure != null && !registered) {
            return new SilenceCause("not-provisioned", failure, 0, Map.of("failure", failure));
        }
        return Optional.ofNullable(connection)
                .flatMap(existing -> of(existing, null))
                .filter(cause -> !cause.code().equals(NO_MEASURE) || cause.time() >= from)
                .orElseGet(() -> new SilenceCause("no-report", "it has not reported yet", 0, Map.of()));
    }

    /**
     * Returns the newest observation since the last report; empty if there is none.
     *
     * @param heard when the last report was received, epoch ms; null if none was
     */
    public static Optional<SilenceCause> of(DeviceConnection connection, Long heard) {
        if (Boolean.FALSE.equals(connection.registered())) {
            return Optional.of(new SilenceCause("not-registered", "the IoT Agent does not know it", 0, Map.of()));
        }
        List<SilenceCause> observed = new ArrayList<>();
        RefusedLogin refusedLogin = connection.refusedLogin();
        if (refusedLogin != null && (connection.loggedIn() == null || refusedLogin.last() > connection.loggedIn())) {
            observed.add(refusal(refusedLogin));
        }
        if (connection.unreadablePayload() != null) {
            UnreadablePayload unreadable = connection.unreadablePayload();
            long count = unreadable.count();
            String last = at(count == 1 ? "at" : "the last at", unreadable.last());
            String text = "%d of its messages could not be read, %s: %s".formatted(count, last, unreadable.reason());
            observed.add(new SilenceCause(
                    "unreadable-payload",
                    text,
                    unreadable.last(),
                    observed(count, unreadable.last(), "reason", unreadable.reason())));
        }
        if (connection.foreignTopic() != null) {
            ForeignTopic foreign = connection.foreignTopic();
            String text = "it published %s to %s, where it may not"
                    .formatted(times(foreign.count(), foreign.last()), foreign.topic());
            observed.add(new SilenceCause(
                    "foreign-topic",
                    text,
                    foreign.last(),
                    observed(foreign.count(), foreign.last(), "topic", foreign.topic())));
        }
        return observed.stream()
                .filter(each -> heard == null || each.time() > heard)
                .max(Comparator.comparingLong(SilenceCause::time))
                .or(() -> Optional.ofNullable(login(connection, heard)));
    }

    private static SilenceCause refusal(RefusedLogin refusedLogin) {
        boolean unknown = refusedLogin.reason().equals(DeviceConnection.UNKNOWN_USER);
        String text = unknown
                ? "its user %s does not exist or no longer, and was refused %s"
                        .formatted(refusedLogin.user(), times(refusedLogin.count(), refusedLogin.last()))
                : "its password was refused " + times(refusedLogin.count(), refusedLogin.last());
        return new SilenceCause(
                refusedLogin.reason(),
                text,
                refusedLogin.last(),
                observed(refusedLogin.count(), refusedLogin.last(), "user", refusedLogin.user()));
    }

    private static SilenceCause login(DeviceConnection connection, Long heard) {
        if (connection.since() == null) {
            return null;
        }
        if (connection.loggedIn() == null) {
            long since = connection.since();
            return new SilenceCause(
                    "no-login",
                    at("it has not connected to the MQTT broker since", since),
                    since,
                    Map.of("time", String.valueOf(since)));
        }
        return heard == null || connection.loggedIn() > heard
                ? new SilenceCause(
                        NO_MEASURE,
                        at("it connected at", connection.loggedIn()) + " and has sent nothing since",
                        connection.loggedIn(),
                        Map.of("time", String.valueOf(connection.loggedIn())))
                : null;
    }

    /** Whether it replaces the cause that is shown for the same device. */
    public boolean replaces(SilenceCause shown) {
        return shown == null || !shown.code().equals(code) || time - shown.time() >= RENEWAL.toMillis();
    }

    /** Returns the values of what was observed several times. */
    private static Map<String, String> observed(long count, long last, String name, String value) {
        return Map.of("count", String.valueOf(count), "time", String.valueOf(last), name, value == null ? "" : value);
    }

    private static String times(long count, long last) {
        return at(Counts.times(count) + (count == 1 ? ", at" : ", last at"), last);
    }

    private static String at(String prefix, long ms) {
        return prefix + " " + Instant.ofEpochMilli(ms).truncatedTo(ChronoUnit.SECONDS);
    }
}
