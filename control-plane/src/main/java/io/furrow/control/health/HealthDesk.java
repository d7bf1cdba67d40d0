package io.furrow.control.health;

import java.math.BigDecimal;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import io.furrow.control.alarm.AlarmDesk;
import io.furrow.control.alarm.Cause;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Records;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.topic.Topics;

/**
 * Keeps {@code service.devices.health} and raises and ends the alarms of silent devices. {@link Listener} tells of silence;
 * a device that was never heard of, or whose listener died with its process, is found by looking at all of them now and then.
 */
final class HealthDesk {
    /** Longer than a device may take to come up, and than signs of life are apart. */
    static final Duration PATIENCE = Duration.ofMinutes(1);

    private static final Duration LOOKED_AT_EVERY = Duration.ofSeconds(10);

    private final Records<DeviceHealth> health;
    private final WantedDevices wanted;
    private final HealthOptions options;
    private final AlarmDesk alarms;
    private final Outbox outbox;
    private long lookedAt;
    private Long began;

    HealthDesk(
            Records<DeviceHealth> health,
            WantedDevices wanted,
            HealthOptions options,
            AlarmDesk alarms,
            Outbox outbox) {
        this.health = health;
        this.wanted = wanted;
        this.options = options;
        this.alarms = alarms;
        this.outbox = outbox;
    }

    /** Takes what was told of the device of a key. */
    void take(String key, Sign sign, long now) {
        Optional<WantedDevice> device = wanted.of(key);
        if (device.isEmpty()) {
            return; // it was stopped meanwhile
        }
        DeviceHealth remembered = health.get(key);
        DeviceHealth known = remembered == null ? DeviceHealth.unheard(device.get(), now) : remembered.of(device.get());
        boolean outdated = known.heard() != null && sign.heard() < known.heard();
        if (outdated) {
            return; // another listener heard it since
        }
        DeviceHealth heard = known.silent() && sign.silent() ? known : known.heard(sign, now);
        keep(key, sign.silent() ? silent(heard, device.get(), now) : talking(heard, known, now));
    }

    private DeviceHealth talking(DeviceHealth heard, DeviceHealth before, long now) {
        if (before.silent()) {
            alarms.end(AlarmKind.SILENT_DEVICE, heard.id(), "it was heard of again", now);
        }
        return heard;
    }

    private DeviceHealth silent(DeviceHealth known, WantedDevice device, long now) {
        if (known.silent()) {
            return known;
        }
        String allowed = BigDecimal.valueOf(options.silentAfter(device), 3)
                .stripTrailingZeros()
                .toPlainString();
        String text = known.heard() == null
                ? "%s of mission %s has not been heard of yet".formatted(known.id(), known.mission())
                : "%s of mission %s was silent for more than %s s".formatted(known.id(), known.mission(), allowed);
        List<Cause.Device> one = List.of(new Cause.Device(known.id(), known.type()));
        alarms.raise(new Cause(AlarmKind.SILENT_DEVICE, known.id(), text, one, null), now);
        return known.silent(now);
    }

    /** Called about once a second. */
    void passTime(long now) {
        if (began == null) {
            began = now;
        }
        if (now - lookedAt < LOOKED_AT_EVERY.toMillis()) {
            return;
        }
        lookedAt = now;
        wanted.forEach(device -> lookAt(device, now));
        forgetUnwanted(now);
    }

    private void lookAt(WantedDevice device, long now) {
        String key = device.version().key();
        DeviceHealth remembered = health.get(key);
        DeviceHealth known = remembered == null ? DeviceHealth.unheard(device, now) : remembered.of(device);
        long quietSince = Math.max(device.version().from(), known.heard() == null ? 0 : known.heard());
        boolean quiet = now - Math.max(quietSince, began) > options.silentAfter(device) + PATIENCE.toMillis();
        DeviceHealth judged = quiet && !known.off() ? silent(known, device, now) : known;
        if (!judged.equals(remembered)) {
            keep(key, judged);
        }
    }

    private void forgetUnwanted(long now) {
        List<DeviceHealth> gone = new ArrayList<>();
        health.forEach(each -> {
            if (wanted.of(each.key()).isEmpty()) {
                gone.add(each);
            }
        });
        for (DeviceHealth each : gone) {
            health.put(each.key(), null);
            outbox.put(Topics.DEVICES_HEALTH, each.key(), null);
            alarms.end(AlarmKind.SILENT_DEVICE, each.id(), "the device is not wanted any more", now);
        }
    }

    private void keep(String key, DeviceHealth device) {
        health.put(key, device);
        outbox.put(Topics.DEVICES_HEALTH, key, device.toBytes());
    }
}
