package io.furrow.connect.sink;

import java.time.Duration;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.LongSupplier;

/**
 * The times of the entities written or read last, as many as hold {@code maxAttributes} attributes together; they are to be read
 * again when the last reading is {@code maxAge} old, because others may have written meanwhile.
 */
final class KnownTimes {
    private final long maxAttributes;
    private final long maxAgeNanos;
    private final LongSupplier nanoClock;
    private final Map<EntityKey, EntityTimes> entities = new LinkedHashMap<>(16, 0.75f, true);
    private long attributes;

    /** @param nanoClock as {@link System#nanoTime} */
    KnownTimes(long maxAttributes, Duration maxAge, LongSupplier nanoClock) {
        this.maxAttributes = maxAttributes;
        this.maxAgeNanos = maxAge.toNanos();
        this.nanoClock = nanoClock;
    }

    /** Whether the entity is known, from a reading that is not too old. */
    boolean isFresh(EntityKey key) {
        EntityTimes times = entities.get(key);
        return times != null && nanoClock.getAsLong() - times.readAtNanos() < maxAgeNanos;
    }

    /** Null where the entity is not known, which is not the same as known to be absent. */
    EntityTimes of(EntityKey key) {
        return entities.get(key);
    }

    /** What was read just now takes the place of what was known; a deletion stays known, no context broker tells of it. */
    void learn(EntityKey key, EntityTimes times) {
        EntityTimes before = entities.put(key, times);
        times.readAt(nanoClock.getAsLong(), before == null ? Change.NO_TIME : before.deletedAt());
        attributes += cost(times) - (before == null ? 0 : cost(before));
    }

    void set(EntityKey key, String type, String name, long time) {
        EntityTimes times = entities.get(key);
        int before = times.size();
        times.put(type, name, time);
        attributes += times.size() - before;
    }

    void delete(EntityKey key, long time) {
        EntityTimes times = entities.get(key);
        attributes -= times.size();
        times.delete(time);
    }

    /** A deletion that newer attributes outlive. */
    void outlive(EntityKey key, long time) {
        EntityTimes times = entities.get(key);
        int before = times.size();
        times.outlive(time);
        attributes -= before - times.size();
    }

    /** Forgets those not seen for longest; between deliveries only, because a delivery needs all its entities. */
    void evict() {
        Iterator<EntityTimes> eldest = entities.values().iterator();
        while (attributes > maxAttributes && eldest.hasNext()) {
            attributes -= cost(eldest.next());
            eldest.remove();
        }
    }

    void clear() {
        entities.clear();
        attributes = 0;
    }

    /** Of attributes, an entity counting as one more. */
    long size() {
        return attributes;
    }

    private static int cost(EntityTimes times) {
        return times.size() + 1;
    }
}
