package io.furrow.control.alarm.action;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.Executor;
import java.util.concurrent.RejectedExecutionException;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.audit.AuditEntry;
import io.furrow.control.device.CommandSender;
import io.furrow.kafka.BoundedMap;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/**
 * Sends one {@code Stop} to each robot of a predicted encounter. This is not a safety function: messages may be late or
 * lost, a robot may not obey, and positions may be wrong. Every result is written to the audit topic, also when no
 * command was sent because the prediction is older than ten seconds in event time or the type of the device is unknown.
 * If all attempts failed, the next record of the same prediction starts again.
 *
 * <p>Decisions never block; the executor sends the commands.
 */
public final class StopRobots {
    static final Duration FRESH = Duration.ofSeconds(10);
    static final int ATTEMPTS = 3;
    static final int MAX_HANDLED = 10_000;
    static final String USER = "alarms";
    static final String STOP = "Stop";
    static final String DEVICE = "device";
    static final String ENCOUNTER = "encounter";
    private static final String SERVICE = "service";
    private static final String SERVICE_PATH = "servicePath";

    private static final String PREDICTED = "predicted";
    private static final Duration PAUSE = Duration.ofMillis(500);
    private static final String SENT = "sent";

    private final Settings settings;
    private final Function<String, String> types;
    private final Consumer<AuditEntry> audit;
    private final Executor executor;
    private final Clock clock;
    /** Result, or reason for not sending, by encounter and device; the eldest entry is evicted. */
    private final Map<String, String> handled = BoundedMap.byInsertion(MAX_HANDLED);

    /**
     * Which robots are stopped, and how.
     *
     * @param types entity types that are robots
     */
    public record Settings(CommandSender sender, Set<String> types) {
        public static Settings of(CommandSender sender) {
            return new Settings(sender, Set.of(DesiredDevice.ROBOT, "ROBOT"));
        }
    }

    /** @param types returns the type of an entity by tenant, service path and id; null if unknown */
    StopRobots(
            Settings settings,
            Function<String, String> types,
            Consumer<AuditEntry> audit,
            Executor executor,
            Clock clock) {
        this.settings = settings;
        this.types = types;
        this.audit = audit;
        this.executor = executor;
        this.clock = clock;
    }

    /** Restores an entry of the audit topic, so that a Stop that any instance has sent is not sent again. */
    void restore(JsonNode entry) {
        if (STOP.equals(entry.path("command").textValue())
                && USER.equals(entry.path("user").textValue())
                && SENT.equals(entry.path("result").textValue())) {
            put(key(entry.path("about")), SENT);
        }
    }

    /** @param time event time of the prediction, epoch ms */
    void take(EncounterReport encounter, long time) {
        if (!encounter.phase().equals(PREDICTED)) {
            return;
        }
        for (EncounterReport.Member member : encounter.members()) {
            String type = member.type(types);
            if (type == null) {
                skip(encounter, member, "the type of its entity is unknown; add it to a mission");
            } else if (settings.types().contains(type)) {
                decide(encounter, member, type, time);
            }
        }
    }

    private void decide(EncounterReport encounter, EncounterReport.Member robot, String type, long time) {
        if (!isFresh(time)) {
            skip(encounter, robot, stale());
        } else if (!SENT.equals(put(key(about(encounter, robot)), SENT))) {
            try {
                executor.execute(() -> stop(encounter, robot, type, time));
            } catch (RejectedExecutionException e) {
                forget(encounter, robot);
                skip(encounter, robot, "too many robots are being stopped at once");
            }
        }
    }

    private void stop(EncounterReport encounter, EncounterReport.Member robot, String type, long time) {
        String failure = "no attempt was made";
        try {
            failure = tryToStop(settings.sender().in(robot.scope()), robot, type, time);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            failure = "the control plane was stopped meanwhile";
        } catch (RuntimeException e) { // every failure belongs on the audit topic
            failure = FailureText.of(e);
        }
        if (failure != null) {
            forget(encounter, robot);
        }
        note(encounter, robot, failure);
    }

    /** Returns why it failed; null if the context broker accepted the command. */
    private String tryToStop(CommandSender sender, EncounterReport.Member robot, String type, long time)
            throws InterruptedException {
        String failure = null;
        for (int attempt = 1; attempt <= ATTEMPTS; attempt++) {
            if (attempt > 1) {
                Thread.sleep(PAUSE.toMillis());
            }
            if (!isFresh(time)) {
                return failure == null ? stale() : stale() + " after this: " + failure;
            }
            try {
                sender.send(robot.id(), type, STOP, "");
                return null;
            } catch (IOException e) {
                failure = e.getMessage();
            }
        }
        return failure;
    }

    private boolean isFresh(long time) {
        return clock.millis() - time <= FRESH.toMillis();
    }

    private static String stale() {
        return "the prediction was older than %d s".formatted(FRESH.toSeconds());
    }

    /** Writes an audit entry, once per reason, that no command was sent. */
    private void skip(EncounterReport encounter, EncounterReport.Member member, String reason) {
        String key = key(about(encounter, member));
        synchronized (handled) {
            String before = handled.get(key);
            if (SENT.equals(before) || reason.equals(before)) {
                return;
            }
            handled.put(key, reason);
        }
        note(encounter, member, reason);
    }

    private void note(EncounterReport encounter, EncounterReport.Member member, String failure) {
        audit.accept(AuditEntry.ofDevice(clock.millis(), USER, STOP, about(encounter, member), failure));
    }

    /** Names the scope of a device that is not in that of the encounter. */
    private static ObjectNode about(EncounterReport encounter, EncounterReport.Member member) {
        ObjectNode about = NgsiJson.object();
        about.put(DEVICE, member.id()).put(ENCOUNTER, encounter.id());
        FiwareScope scope = member.scope();
        return scope.equals(encounter.first().scope())
                ? about
                : about.put(SERVICE, scope.service()).put(SERVICE_PATH, scope.servicePath());
    }

    private void forget(EncounterReport encounter, EncounterReport.Member robot) {
        synchronized (handled) {
            handled.remove(key(about(encounter, robot)));
        }
    }

    private String put(String key, String command) {
        synchronized (handled) {
            return handled.put(key, command);
        }
    }

    private static String key(JsonNode about) {
        return Stream.of(ENCOUNTER, SERVICE, SERVICE_PATH, DEVICE)
                .map(name -> about.path(name).asText())
                .collect(Collectors.joining("|"));
    }
}
