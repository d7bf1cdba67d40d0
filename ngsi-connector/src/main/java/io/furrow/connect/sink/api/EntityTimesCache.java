package io.furrow.connect.sink.api;

import java.time.Duration;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.LongSupplier;

/**
 * Caches the times of the entities written or read last, up to {@code maxAttributes} attributes in total. Entries
 * expire {@code maxAge} after the last reading, because other tasks may have written meanwhile.
 */
public final class EntityTimesCache {
    private final long maxAttributes;
    private final long maxAgeNanos;
    private final LongSupplier nanoClock;
    private final Map<EntityKey, EntityTimes> entities = new LinkedHashMap<>(16, 0.75f, true);
    private long attributes;

    /** @param nanoClock as {@link System#nanoTime} */
    public EntityTimesCache(long maxAttributes, Duration maxAge, LongSupplier nanoClock) {
        this.maxAttributes = maxAttributes;
        this.maxAgeNanos = maxAge.toNanos();
        this.nanoClock = nanoClock;
    }

    /** Whether the entity is cached and its entry has not expired. */
    boolean isFresh(EntityKey key) {
        EntityTimes times = entities.get(key);
        return times != null && nanoClock.getAsLong() - times.readAtNanos() < maxAgeNanos;
    }

    /** Null if the entity is not cached, as opposed to cached as absent. */
    EntityTimes of(EntityKey key) {
        return entities.get(key);
    }

    /** Replaces the cached times by those just read; a deletion stays cached, because no context broker reports it. */
    void learn(EntityKey key, EntityTimes times) {
        EntityTimes before = entities.put(key, times);
        times.readAt(nanoClock.getAsLong(), before);
        attributes += cost(times) - (before == null ? 0 : cost(before));
    }

    void set(EntityKey key, String type, String name, long time) {
        change(key, times -> times.put(type, name, time));
    }

    /** Newer attributes outlive the deletion. */
    void delete(EntityChange deletion) {
        change(deletion.key(), times -> times.delete(deletion));
    }

    private void change(EntityKey key, Consumer<EntityTimes> change) {
        EntityTimes times = entities.get(key);
        int before = cost(times);
        change.accept(times);
        attributes += cost(times) - before;
    }

    /**
     * Removes the entities that were unused longest; only between deliveries, because a delivery needs all its
     * entities.
     */
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

    /** Number of attributes; an entity and a deletion count as one more. */
    long size() {
        return attributes;
    }

    private static int cost(EntityTimes times) {
        return times.size() + times.deletions() + 1;
    }
}
