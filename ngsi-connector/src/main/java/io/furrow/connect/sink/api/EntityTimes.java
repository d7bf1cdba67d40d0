package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * Stores the event time of every attribute of an entity, per type if several entities share the id, and of its last
 * deletion. Uses arrays, because a hundred thousand entities are cached.
 */
final class EntityTimes {
    private String[] types = {};
    private String[] names = {};
    private long[] times = {};
    private long deletedAt = EntityChange.NO_TIME;
    private long readAtNanos;

    /** {@link EntityChange#NO_TIME} if unknown. */
    long of(String type, String name) {
        int found = find(type, name);
        return found < 0 ? EntityChange.NO_TIME : times[found];
    }

    boolean has(String type, String name) {
        return find(type, name) >= 0;
    }

    long deletedAt() {
        return deletedAt;
    }

    /** The time of reading from the context broker, by the clock of {@link EntityTimesCache}. */
    long readAtNanos() {
        return readAtNanos;
    }

    void readAt(long nanos, long deletedAt) {
        this.readAtNanos = nanos;
        this.deletedAt = deletedAt;
    }

    /** The newest time of all attributes of all types. */
    long newest() {
        return Arrays.stream(times).max().orElse(EntityChange.NO_TIME);
    }

    /** The number of attributes. */
    int size() {
        return names.length;
    }

    void put(String type, String name, long time) {
        int found = find(type, name);
        if (found >= 0) {
            times[found] = time;
            return;
        }
        int last = names.length;
        types = Arrays.copyOf(types, last + 1);
        names = Arrays.copyOf(names, last + 1);
        times = Arrays.copyOf(times, last + 1);
        types[last] = type.intern();
        names[last] = name.intern();
        times[last] = time;
    }

    /** Removes all attributes; values older than the deletion stay deleted. */
    void delete(long time) {
        types = new String[0];
        names = new String[0];
        times = new long[0];
        deletedAt = Math.max(deletedAt, time);
    }

    /** An attribute of an entity of this type. */
    record Name(String type, String attribute) {}

    /** The attributes that are not newer. */
    List<Name> upTo(long time) {
        List<Name> older = new ArrayList<>();
        for (int i = 0; i < names.length; i++) {
            if (times[i] <= time) {
                older.add(new Name(types[i], names[i]));
            }
        }
        return older;
    }

    /** Stores a deletion that newer attributes outlive, and removes the other attributes. */
    void outlive(long time) {
        deletedAt = Math.max(deletedAt, time);
        int kept = 0;
        for (int i = 0; i < names.length; i++) {
            if (times[i] > time) {
                types[kept] = types[i];
                names[kept] = names[i];
                times[kept++] = times[i];
            }
        }
        types = Arrays.copyOf(types, kept);
        names = Arrays.copyOf(names, kept);
        times = Arrays.copyOf(times, kept);
    }

    private int find(String type, String name) {
        for (int i = 0; i < names.length; i++) {
            if (names[i].equals(name) && types[i].equals(type)) {
                return i;
            }
        }
        return -1;
    }
}
