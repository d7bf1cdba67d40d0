package io.furrow.connect.sink;

import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;

/** The times of the entities written or read last, as many as hold {@code maxAttributes} attributes together. */
final class KnownTimes {
    private final long maxAttributes;
    private final Map<EntityKey, EntityTimes> entities = new LinkedHashMap<>(16, 0.75f, true);
    private long attributes;

    KnownTimes(long maxAttributes) {
        this.maxAttributes = maxAttributes;
    }

    /** Null where the entity is not known, which is not the same as known to be absent. */
    EntityTimes of(EntityKey key) {
        return entities.get(key);
    }

    void put(EntityKey key, EntityTimes times) {
        EntityTimes before = entities.put(key, times);
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
