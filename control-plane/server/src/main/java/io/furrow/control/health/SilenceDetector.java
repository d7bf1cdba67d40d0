package io.furrow.control.health;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.time.Elapsed;

/**
 * Reduces the reports of devices to heartbeats: emits one at the first report of a device, then one with its newest
 * report every 30 seconds, and one when it has been silent for too long. Ten thousand devices yield some hundred
 * heartbeats a second. Silence is measured by the clock of the control plane, so that neither a device's clock nor a
 * delayed read causes it.
 *
 * <p>Notifications that the context broker sends because of a command to the device are not reports, see
 * {@link ReportedState}.
 */
final class SilenceDetector {
    static final Duration HEARTBEAT_INTERVAL = Duration.ofSeconds(30);

    static final String STATUS = "Status";
    /** Its values if the device is switched off; the dashboard's page has the same. */
    private static final Set<String> OFF = Set.of("false", "0", "off");

    private static final Duration MAX_TICK = Duration.ofSeconds(2);
    private static final Duration LOOKUP_INTERVAL = Duration.ofSeconds(5);

    private final HealthOptions options;
    private final MonitoredDevices desired;
    private final HeartbeatListener listener;
    private final Map<String, TrackedDevice> devices = new HashMap<>();
    private long refreshedAt;
    private long lastTick;

    interface HeartbeatListener {
        /** @param key of {@code service.devices} */
        void emit(String key, Heartbeat heartbeat);
    }

    private static final class TrackedDevice {
        /** Null until the device reports. */
        private Heartbeat newest;

        private ReportedState state;
        private boolean percent;
        /** Desired type; null if unknown. */
        private String type;

        private long emittedAt;
        /** Whether the newest report was not emitted yet. */
        private boolean pending;

        private boolean silent;
        private long silentAfter;
        private long from;

        boolean isDue(long now) {
            return Elapsed.hasPassed(HEARTBEAT_INTERVAL.toMillis(), emittedAt, now);
        }

        /** Whether an entity is the device: several types may have its id, of which the desired one, else the first is. */
        boolean isOf(Entity entity) {
            return newest == null
                    || entity.type().equals(newest.type())
                    || entity.type().equalsIgnoreCase(type)
                    || silent && !newest.type().equalsIgnoreCase(type);
        }

        /** Updates the settings of the device; after a new start of its mission the next report is emitted immediately. */
        void take(DesiredDevice device, long after) {
            silentAfter = after;
            type = device.type();
            if (from != device.version().from()) {
                from = device.version().from();
                emittedAt = 0;
                pending = false;
            }
        }
    }

    SilenceDetector(HealthOptions options, MonitoredDevices desired, HeartbeatListener listener) {
        this.options = options;
        this.desired = desired;
        this.listener = listener;
    }

    /** Whether the device is desired, so that its reports are parsed. */
    boolean isMonitored(String key) {
        if (devices.containsKey(key)) {
            return true;
        }
        TrackedDevice added = new TrackedDevice();
        boolean isDesired = isDesiredStill(key, added);
        if (isDesired) {
            devices.put(key, added);
        }
        return isDesired;
    }

    /**
     * Processes a report of a desired device.
     *
     * @param reported event time, epoch ms
     * @param now epoch ms
     * @return whether the report counts as a heartbeat
     */
    boolean process(String key, Entity entity, long reported, long now) {
        TrackedDevice tracked = devices.get(key);
        boolean first = tracked.newest == null || !entity.type().equals(tracked.newest.type());
        if (!tracked.isOf(entity) || first && !isMeasured(entity)) {
            return false;
        }
        ReportedState before = tracked.state;
        tracked.state = ReportedState.of(entity);
        if (!first && !tracked.state.isReportAfter(before, tracked.newest.reported() != reported)) {
            return false;
        }
        Long deviceTime = EventTimeRule.Source.DEVICE
                .read(entity)
                .map(Instant::toEpochMilli)
                .orElse(null);
        tracked.percent = Battery.isPercent(entity) || !first && tracked.percent;
        Double battery = Battery.levelOf(entity, tracked.percent);
        boolean off = entity.value(STATUS)
                .filter(status -> status.isNumber()
                        ? status.doubleValue() == 0
                        : OFF.contains(status.asText().toLowerCase(Locale.ROOT)))
                .isPresent();
        boolean switched = !first && off != tracked.newest.off();
        boolean isAbsent = battery == null && !first;
        Boolean percent = tracked.percent || Battery.isUnitless(entity) ? Boolean.valueOf(tracked.percent) : null;
        tracked.newest = new Heartbeat(
                entity.id(),
                entity.type(),
                false,
                now,
                reported,
                deviceTime,
                isAbsent ? tracked.newest.battery() : battery,
                isAbsent ? tracked.newest.percent() : percent,
                off);
        tracked.pending = true;
        if (first || tracked.silent || switched || tracked.isDue(now)) {
            tracked.silent = false;
            emit(key, tracked, now);
        }
        return true;
    }

    private void emit(String key, TrackedDevice tracked, long now) {
        tracked.emittedAt = now;
        tracked.pending = false;
        listener.emit(key, tracked.newest);
    }

    /** Whether the entity has values other than assigned attributes and commands. */
    private static boolean isMeasured(Entity entity) {
        List<Map.Entry<String, JsonNode>> attributes = entity.attributes();
        return attributes.isEmpty()
                || attributes.stream()
                        .filter(ReportedState::isMeasured)
                        .anyMatch(each -> entity.value(each.getKey())
                                .filter(value ->
                                        !value.isTextual() || !value.textValue().isBlank())
                                .isPresent());
    }

    /** Called about once a second. After a pause, in which no reports were read, detects no silence until the pending reports are read. */
    void passTime(long now) {
        boolean paused = Elapsed.hasPassed(MAX_TICK.toMillis() + 1, lastTick, now);
        lastTick = now;
        if (Elapsed.hasPassed(LOOKUP_INTERVAL.toMillis(), refreshedAt, now)) {
            refreshedAt = now;
            devices.entrySet().removeIf(entry -> !isDesiredStill(entry.getKey(), entry.getValue()));
        }
        if (!paused) {
            emitSilent(now);
        }
    }

    private void emitSilent(long now) {
        devices.forEach((key, tracked) -> {
            if (tracked.newest != null && tracked.newest.heard() > now) { // the clock was set back
                tracked.newest = tracked.newest.heardAt(now);
            }
            if (!tracked.silent
                    && tracked.newest != null
                    && !tracked.newest.off()
                    && now - tracked.newest.heard() > tracked.silentAfter) {
                tracked.silent = true;
                tracked.pending = false;
                listener.emit(key, tracked.newest.silenced());
            } else if (tracked.pending && tracked.isDue(now)) { // the next report may be hours away
                emit(key, tracked, now);
            }
        });
    }

    private boolean isDesiredStill(String key, TrackedDevice tracked) {
        Optional<DesiredDevice> device = desired.of(key);
        device.ifPresent(found -> tracked.take(found, options.silentAfter(found)));
        return device.isPresent();
    }
}
