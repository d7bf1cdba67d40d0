package io.furrow.connect.sink.api;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;
import java.util.stream.IntStream;

/**
 * Stores the event time of every attribute of an entity, per type if several entities share the id, and of the last
 * deletion of each type. Uses arrays, because a hundred thousand entities are cached.
 */
final class EntityTimes {
    private String[] types = {};
    private String[] names = {};
    private long[] times = {};
    /** By type, empty for all types. */
    private Map<String, Long> deletions = Map.of();

    private long readAtNanos;

    /** {@link EntityChange#NO_TIME} if unknown. */
    long of(String type, String name) {
        int found = find(type, name);
        return found < 0 ? EntityChange.NO_TIME : times[found];
    }

    boolean has(String type, String name) {
        return find(type, name) >= 0;
    }

    /** Of the last deletion of the type, or of all. */
    long deletedAt(String type) {
        return Math.max(
                deletions.getOrDefault("", EntityChange.NO_TIME), deletions.getOrDefault(type, EntityChange.NO_TIME));
    }

    int deletions() {
        return deletions.size();
    }

    /** The time of reading from the context broker, by the clock of {@link EntityTimesCache}. */
    long readAtNanos() {
        return readAtNanos;
    }

    /** @param before whose deletions it takes over; null for none */
    void readAt(long nanos, EntityTimes before) {
        readAtNanos = nanos;
        deletions = before == null ? Map.of() : before.deletions;
    }

    /** The newest time of all attributes of some types. */
    long newest(Predicate<String> ofType) {
        return IntStream.range(0, times.length)
                .filter(i -> ofType.test(types[i]))
                .mapToLong(i -> times[i])
                .max()
                .orElse(EntityChange.NO_TIME);
    }

    /** Whether an entity that a deletion deletes may exist; one without attributes may be of any type. */
    boolean mayBeOf(EntityChange deletion) {
        return types.length == 0 || Arrays.stream(types).anyMatch(deletion::deletes);
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

    /** An attribute of an entity of this type. */
    record Name(String type, String attribute) {}

    /** The attributes that a deletion deletes: newer ones outlive it. */
    List<Name> deletedBy(EntityChange deletion) {
        List<Name> older = new ArrayList<>();
        for (int i = 0; i < names.length; i++) {
            if (isDeleted(i, deletion)) {
                older.add(new Name(types[i], names[i]));
            }
        }
        return older;
    }

    /** Stores a deletion, and removes the attributes that it deletes; older values stay deleted. */
    void delete(EntityChange deletion) {
        Map<String, Long> next = new HashMap<>(deletions);
        next.merge(deletion.type(), deletion.time(), Math::max);
        deletions = Map.copyOf(next);
        int kept = 0;
        for (int i = 0; i < names.length; i++) {
            if (!isDeleted(i, deletion)) {
                types[kept] = types[i];
                names[kept] = names[i];
                times[kept++] = times[i];
            }
        }
        types = Arrays.copyOf(types, kept);
        names = Arrays.copyOf(names, kept);
        times = Arrays.copyOf(times, kept);
    }

    private boolean isDeleted(int i, EntityChange deletion) {
        return deletion.deletes(types[i]) && times[i] <= deletion.time();
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
