package io.furrow.simulators.host;

import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.function.BiConsumer;

import io.furrow.model.device.DeviceStatus;

/**
 * Determines the status of each device: running only once it is connected, failed with the reason after {@value
 * #MAX_ATTEMPTS} attempts.
 */
final class StatusPublisher {
    /** Some nine seconds. */
    static final int MAX_ATTEMPTS = 8;

    private final BiConsumer<String, DeviceStatus> publish;
    private final Map<String, Entry> byKey = new HashMap<>();
    private final Map<String, String> keys = new HashMap<>();

    /**
     * State of a desired device.
     *
     * @param device its id in the fleet
     * @param status that of a running device
     * @param up whether it is connected
     * @param trouble why it is not; null while it may still connect
     */
    private record Entry(String device, DeviceStatus status, boolean up, String trouble) {}

    /** @param publish receives each status with the key of its device */
    StatusPublisher(BiConsumer<String, DeviceStatus> publish) {
        this.publish = publish;
    }

    /** The key of the device with this id; empty if none runs or starts. */
    Optional<String> keyOf(String device) {
        return Optional.ofNullable(keys.get(device));
    }

    /** Adds a device that is being connected. */
    void begun(String key, String device, DeviceStatus running) {
        put(key, new Entry(device, running, false, null));
    }

    /** Updates the sequence of a device. */
    void confirmed(String key, DeviceStatus running) {
        Entry entry = byKey.get(key);
        put(key, new Entry(entry.device(), running, entry.up(), entry.trouble()));
    }

    /**
     * Removes a device.
     *
     * @param status null for a tombstone
     */
    void ended(String key, DeviceStatus status) {
        Entry entry = byKey.remove(key);
        if (entry != null) {
            keys.remove(entry.device(), key);
        }
        publish.accept(key, status);
    }

    void up(String device) {
        keyOf(device).ifPresent(key -> {
            Entry entry = byKey.get(key);
            put(key, new Entry(device, entry.status(), true, null));
        });
    }

    void failed(String device, int attempts, String reason) {
        keyOf(device).ifPresent(key -> {
            Entry entry = byKey.get(key);
            if (attempts >= MAX_ATTEMPTS && !entry.up()) {
                put(key, new Entry(device, entry.status(), false, reason));
            }
        });
    }

    private void put(String key, Entry entry) {
        byKey.put(key, entry);
        keys.put(entry.device(), key);
        if (entry.up()) {
            publish.accept(key, entry.status());
        } else if (entry.trouble() != null) {
            publish.accept(
                    key, new DeviceStatus(entry.status().sequence(), DeviceStatus.State.FAILED, entry.trouble()));
        }
    }
}
