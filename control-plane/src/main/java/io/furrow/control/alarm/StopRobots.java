package io.furrow.control.alarm;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.util.Set;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.audit.AuditEntry;
import io.furrow.control.device.CommandSender;
import io.furrow.model.control.AlarmKind;

/**
 * Sends {@code Stop} to the robots of a predicted encounter, once when that is new. This is no safety function: messages may be
 * late or lost, a robot may not obey, and positions may be wrong. Every attempt is on the audit topic, and so is what was left
 * undone: a prediction that is older than ten seconds, a device of which the type is not known.
 */
public final class StopRobots implements AlarmFollower.Action {
    static final Duration FRESH = Duration.ofSeconds(10);
    static final int ATTEMPTS = 3;

    private static final String USER = "alarms";
    private static final String STOP = "Stop";
    private static final Duration PAUSE = Duration.ofMillis(500);

    private final Settings settings;
    private final Consumer<AuditEntry> audit;
    private final Clock clock;

    /**
     * Who is stopped, and how.
     *
     * @param types of entities that are robots
     */
    public record Settings(CommandSender sender, Set<String> types) {
        public static Settings of(CommandSender sender) {
            return new Settings(sender, Set.of("Robot", "ROBOT"));
        }
    }

    StopRobots(Settings settings, Consumer<AuditEntry> audit, Clock clock) {
        this.settings = settings;
        this.audit = audit;
        this.clock = clock;
    }

    @Override
    public void take(Alarm alarm) throws InterruptedException {
        if (alarm.kind() != AlarmKind.PREDICTED_ENCOUNTER || alarm.change() != Alarm.Change.OPENED) {
            return;
        }
        boolean fresh = clock.millis() - alarm.raised() <= FRESH.toMillis();
        for (Cause.Device device : alarm.devices()) {
            if (device.type() == null) {
                note(alarm, device, "nobody knows what type of entity it is; put it on a mission");
            } else if (settings.types().contains(device.type())) {
                note(
                        alarm,
                        device,
                        fresh ? stop(device) : "the prediction was older than %d s".formatted(FRESH.toSeconds()));
            }
        }
    }

    /** Answers why it failed, null where the context broker took it. */
    private String stop(Cause.Device device) throws InterruptedException {
        String failure = null;
        for (int attempt = 1; attempt <= ATTEMPTS; attempt++) {
            if (attempt > 1) {
                Thread.sleep(PAUSE.toMillis());
            }
            try {
                settings.sender().send(device.id(), device.type(), STOP, "");
                return null;
            } catch (IOException e) {
                failure = e.getMessage();
            }
        }
        return failure;
    }

    private void note(Alarm alarm, Cause.Device device, String failure) {
        ObjectNode about = JsonNodeFactory.instance.objectNode();
        about.put("device", device.id()).put("alarm", alarm.alarm());
        audit.accept(AuditEntry.ofDevice(clock.millis(), USER, STOP, about, failure));
    }
}
