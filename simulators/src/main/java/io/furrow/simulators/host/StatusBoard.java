package io.furrow.simulators.host;

import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.function.BiConsumer;

import io.furrow.model.device.DeviceStatus;

/**
 * What is to be said of each device: that it runs only once its connection stands, and why that does not come about when it was
 * tried {@value #PATIENCE} times.
 */
final class StatusBoard {
    /** Some nine seconds. */
    static final int PATIENCE = 8;

    private final BiConsumer<String, DeviceStatus> say;
    private final Map<String, Entry> byKey = new HashMap<>();
    private final Map<String, String> keys = new HashMap<>();

    /**
     * What is known of a device that is wanted.
     *
     * @param device its id in the fleet
     * @param status that of a device that runs
     * @param up whether its connection stands
     * @param trouble why it does not; null while that may still come
     */
    private record Entry(String device, DeviceStatus status, boolean up, String trouble) {}

    /** @param say is given each status with the key of its device */
    StatusBoard(BiConsumer<String, DeviceStatus> say) {
        this.say = say;
    }

    /** The key under which a device of this id runs, or is about to; empty where none does. */
    Optional<String> keyOf(String device) {
        return Optional.ofNullable(keys.get(device));
    }

    /** A device that is connected from now on. */
    void begun(String key, String device, DeviceStatus running) {
        put(key, new Entry(device, running, false, null));
    }

    /** The same device goes on under another sequence. */
    void confirmed(String key, DeviceStatus running) {
        Entry entry = byKey.get(key);
        put(key, new Entry(entry.device(), running, entry.up(), entry.trouble()));
    }

    /** A device that no longer runs, or never did. @param status null where it is forgotten */
    void ended(String key, DeviceStatus status) {
        Entry entry = byKey.remove(key);
        if (entry != null) {
            keys.remove(entry.device(), key);
        }
        say.accept(key, status);
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
            if (attempts >= PATIENCE && !entry.up()) {
                put(key, new Entry(device, entry.status(), false, reason));
            }
        });
    }

    private void put(String key, Entry entry) {
        byKey.put(key, entry);
        keys.put(entry.device(), key);
        if (entry.up()) {
            say.accept(key, entry.status());
        } else if (entry.trouble() != null) {
            say.accept(key, new DeviceStatus(entry.status().sequence(), DeviceStatus.State.FAILED, entry.trouble()));
        }
    }
}
