package io.furrow.control.health;

import java.time.Duration;
import java.util.HashSet;
import java.util.Optional;
import java.util.Set;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Table;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.time.Elapsed;
import io.furrow.model.topic.Topics;

/**
 * Maintains {@code service.devices.health}, and runs {@link SilenceAlarmReconciler} about once a second. {@link
 * SilenceDetector} reports silence. Periodic polling of all devices finds those that never reported or whose detector
 * died with its process.
 */
final class DeviceHealthTracker {
    /** Longer than a device takes to start, and than the interval of heartbeats. */
    static final Duration TIMEOUT = Duration.ofMinutes(1);

    private static final Duration POLL_INTERVAL = Duration.ofSeconds(10);

    private final Table<DeviceHealth> health;
    private final MonitoredDevices desired;
    private final HealthOptions options;
    private final SilenceAlarmReconciler silence;
    private final EventPublisher publisher;
    private long checkedAt;
    private Long startedAt;

    DeviceHealthTracker(
            Table<DeviceHealth> health,
            MonitoredDevices desired,
            HealthOptions options,
            SilenceAlarmReconciler silence,
            EventPublisher publisher) {
        this.health = health;
        this.desired = desired;
        this.options = options;
        this.silence = silence;
        this.publisher = publisher;
    }

    void take(String key, Heartbeat heartbeat, long now) {
        if (heartbeat.isPulse()) {
            silence.reported(heartbeat.heard());
            return;
        }
        Optional<DesiredDevice> device = desired.of(key);
        if (device.isEmpty()) {
            return; // the device was stopped meanwhile
        }
        DeviceHealth stored = health.get(key);
        DeviceHealth existing = stored == null ? DeviceHealth.unreported(device.get(), now) : stored.of(device.get());
        long newest = heard(existing, now);
        if (heartbeat.heard() < newest || existing.isOfOtherType(heartbeat, device.get())) {
            return; // another detector has a newer report, or a new one does not know the device yet
        }
        DeviceHealth reported = existing.silent() && heartbeat.silent() ? existing : existing.reported(heartbeat, now);
        DeviceHealth next = heartbeat.silent() && !reported.silent() ? reported.silent(now) : reported;
        store(key, next);
        watch(key, next, device.get());
        if (!heartbeat.silent()) {
            silence.reported(heartbeat.heard());
        }
    }

    /** Called about once a second. */
    void passTime(long now) {
        if (startedAt == null || startedAt > now) {
            startedAt = now;
        }
        if (Elapsed.hasPassed(POLL_INTERVAL.toMillis(), checkedAt, now)) {
            checkedAt = now;
            Set<String> running = new HashSet<>();
            desired.forEach(device -> {
                running.add(device.version().key());
                check(device, now);
            });
            removeAllExcept(running);
        }
        silence.reconcile(startedAt, now);
    }

    private void check(DesiredDevice device, long now) {
        String key = device.version().key();
        DeviceHealth stored = health.get(key);
        DeviceHealth existing = stored == null ? DeviceHealth.unreported(device, now) : stored.of(device);
        long from = device.version().from() > now ? 0 : device.version().from();
        long silentSince = Math.max(from, heard(existing, now));
        boolean silent = now - Math.max(silentSince, startedAt) > options.silentAfter(device) + TIMEOUT.toMillis();
        DeviceHealth next = silent && !existing.report().off() && !existing.silent() ? existing.silent(now) : existing;
        if (!next.equals(stored)) {
            store(key, next);
        }
        watch(key, next, device);
    }

    /** When it was heard; 0 if never, or if a clock that was ahead says so, of another host or of this one. */
    private static long heard(DeviceHealth device, long now) {
        Long heard = device.report().heard();
        return heard == null || heard > now ? 0 : heard;
    }

    private void removeAllExcept(Set<String> running) {
        for (DeviceHealth each : health.where(some -> !running.contains(some.key()))) {
            health.put(each.key(), null);
            publisher.put(Topics.DEVICES_HEALTH, each.key(), null);
            silence.remove(each.key());
        }
    }

    private void watch(String key, DeviceHealth device, DesiredDevice desiredDevice) {
        silence.put(key, SilenceAlarmReconciler.MonitoredDevice.of(device, options.silentAfter(desiredDevice)));
    }

    private void store(String key, DeviceHealth device) {
        health.put(key, device);
        publisher.put(Topics.DEVICES_HEALTH, key, device.toBytes());
    }
}
