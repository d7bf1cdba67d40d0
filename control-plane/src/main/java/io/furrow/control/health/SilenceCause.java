package io.furrow.control.health;

import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;

/**
 * Why a device does not report, as far as its MQTT broker and the IoT Agent know.
 *
 * @param code of the kind of cause
 * @param text a part of a sentence about the device
 */
public record SilenceCause(String code, String text) {
    private record Observed(long time, SilenceCause cause) {}

    /**
     * The newest of what was observed since the last report; empty if nothing was.
     *
     * @param heard when the last report arrived, epoch ms; null if none did
     */
    public static Optional<SilenceCause> of(DeviceConnection connection, Long heard) {
        if (Boolean.FALSE.equals(connection.registered())) {
            return Optional.of(new SilenceCause("not-registered", "the IoT Agent does not know it"));
        }
        List<Observed> observed = new ArrayList<>();
        RefusedLogin refused = connection.refusedLogin();
        if (refused != null && (connection.loggedIn() == null || refused.last() > connection.loggedIn())) {
            observed.add(new Observed(refused.last(), refusal(refused)));
        }
        if (connection.unreadablePayload() != null) {
            long last = connection.unreadablePayload().last();
            String text = "%d of its messages could not be read, the last at %s: %s"
                    .formatted(
                            connection.unreadablePayload().count(),
                            time(last),
                            connection.unreadablePayload().reason());
            observed.add(new Observed(last, new SilenceCause("unreadable-payload", text)));
        }
        if (connection.foreignTopic() != null) {
            long last = connection.foreignTopic().last();
            String text = "it published %d times where it may not, last at %s to %s"
                    .formatted(
                            connection.foreignTopic().count(),
                            time(last),
                            connection.foreignTopic().topic());
            observed.add(new Observed(last, new SilenceCause("foreign-topic", text)));
        }
        return observed.stream()
                .filter(each -> heard == null || each.time() > heard)
                .max(Comparator.comparingLong(Observed::time))
                .map(Observed::cause)
                .or(() -> Optional.ofNullable(login(connection, heard)));
    }

    private static SilenceCause refusal(RefusedLogin refused) {
        boolean unknown = refused.reason().equals(DeviceConnection.UNKNOWN_USER);
        String text = unknown
                ? "its user %s does not exist or no longer, and was refused %d times, last at %s"
                        .formatted(refused.user(), refused.count(), time(refused.last()))
                : "its password was refused %d times, last at %s".formatted(refused.count(), time(refused.last()));
        return new SilenceCause(refused.reason(), text);
    }

    private static SilenceCause login(DeviceConnection connection, Long heard) {
        if (connection.since() == null) {
            return null;
        }
        if (connection.loggedIn() == null) {
            return new SilenceCause(
                    "no-login", "it has not connected to the MQTT broker since %s".formatted(time(connection.since())));
        }
        return heard == null || connection.loggedIn() > heard
                ? new SilenceCause(
                        "no-measure",
                        "it connected at %s and has sent nothing since".formatted(time(connection.loggedIn())))
                : null;
    }

    private static Instant time(long ms) {
        return Instant.ofEpochMilli(ms).truncatedTo(ChronoUnit.SECONDS);
    }
}
