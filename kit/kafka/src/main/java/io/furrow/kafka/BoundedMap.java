package io.furrow.kafka;

import java.util.LinkedHashMap;
import java.util.Map;

/** Drops its eldest entry when it exceeds a maximum size. Not thread-safe. */
public final class BoundedMap<K, V> extends LinkedHashMap<K, V> {
    private static final long serialVersionUID = 1L;
    private final int max;

    private BoundedMap(int max, boolean byAccess) {
        super(16, 0.75f, byAccess);
        this.max = max;
    }

    /** The eldest entry is the one that was put first. */
    public static <K, V> BoundedMap<K, V> byInsertion(int max) {
        return new BoundedMap<>(max, false);
    }

    /** The eldest entry is the least recently accessed one. */
    public static <K, V> BoundedMap<K, V> byAccess(int max) {
        return new BoundedMap<>(max, true);
    }

    @Override
    protected boolean removeEldestEntry(Map.Entry<K, V> eldest) {
        return size() > max;
    }
}
