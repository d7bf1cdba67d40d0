package io.furrow.control.health;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Table;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.topic.Topics;

/**
 * Maintains {@code service.devices.health}, and lets {@link SilenceAlarmReconciler} reconcile the alarms with it about once a second.
 * {@link SilenceDetector} reports silence. Periodic polling of all devices finds those that never reported or whose
 * detector died with its process.
 */
final class DeviceHealthTracker {
    /** Longer than a device takes to start, and than the interval of heartbeats. */
    static final Duration TIMEOUT = Duration.ofMinutes(1);

    private static final Duration POLL_INTERVAL = Duration.ofSeconds(10);

    private final Table<DeviceHealth> health;
    private final MonitoredDevices desired;
    private final HealthOptions options;
    private final SilenceAlarmReconciler silence;
    private final EventPublisher outbox;
    private long lookedAt;
    private Long began;

    DeviceHealthTracker(
            Table<DeviceHealth> health,
            MonitoredDevices desired,
            HealthOptions options,
            SilenceAlarmReconciler silence,
            EventPublisher outbox) {
        this.health = health;
        this.desired = desired;
        this.options = options;
        this.silence = silence;
        this.outbox = outbox;
    }

    /** Processes a heartbeat of the device of a key. */
    void take(String key, Heartbeat sign, long now) {
        if (sign.isPulse()) {
            silence.reported(sign.heard());
            return;
        }
        Optional<DesiredDevice> device = desired.of(key);
        if (device.isEmpty()) {
            return; // the device was stopped meanwhile
        }
        DeviceHealth remembered = health.get(key);
        DeviceHealth known = remembered == null ? DeviceHealth.unheard(device.get(), now) : remembered.of(device.get());
        boolean outdated = known.heard() != null && sign.heard() < known.heard();
        if (outdated) {
            return; // another detector has a newer report
        }
        DeviceHealth heard = known.silent() && sign.silent() ? known : known.heard(sign, now);
        DeviceHealth judged = sign.silent() && !heard.silent() ? heard.silent(now) : heard;
        keep(key, judged);
        watch(key, judged, device.get());
        if (!sign.silent()) {
            silence.reported(sign.heard());
        }
    }

    /** Called about once a second. */
    void passTime(long now) {
        if (began == null) {
            began = now;
        }
        if (now - lookedAt >= POLL_INTERVAL.toMillis()) {
            lookedAt = now;
            Set<String> running = new HashSet<>();
            desired.forEach(device -> {
                running.add(device.version().key());
                lookAt(device, now);
            });
            forgetAllBut(running);
        }
        silence.reconcile(began, now);
    }

    private void lookAt(DesiredDevice device, long now) {
        String key = device.version().key();
        DeviceHealth remembered = health.get(key);
        DeviceHealth known = remembered == null ? DeviceHealth.unheard(device, now) : remembered.of(device);
        long quietSince = Math.max(device.version().from(), known.heard() == null ? 0 : known.heard());
        boolean quiet = now - Math.max(quietSince, began) > options.silentAfter(device) + TIMEOUT.toMillis();
        DeviceHealth judged = quiet && !known.off() && !known.silent() ? known.silent(now) : known;
        if (!judged.equals(remembered)) {
            keep(key, judged);
        }
        watch(key, judged, device);
    }

    private void forgetAllBut(Set<String> running) {
        List<DeviceHealth> gone = new ArrayList<>();
        health.forEach(each -> {
            if (!running.contains(each.key())) {
                gone.add(each);
            }
        });
        for (DeviceHealth each : gone) {
            health.put(each.key(), null);
            outbox.put(Topics.DEVICES_HEALTH, each.key(), null);
            silence.remove(each.key());
        }
    }

    private void watch(String key, DeviceHealth device, DesiredDevice desiredDevice) {
        silence.put(key, SilenceAlarmReconciler.MonitoredDevice.of(device, options.silentAfter(desiredDevice)));
    }

    private void keep(String key, DeviceHealth device) {
        health.put(key, device);
        outbox.put(Topics.DEVICES_HEALTH, key, device.toBytes());
    }
}
