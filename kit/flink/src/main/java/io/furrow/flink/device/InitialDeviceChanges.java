package io.furrow.flink.device;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;

/** The changes of devices that were read when a function was opened, until its stream of changes has passed them. */
final class InitialDeviceChanges {
    private final Map<String, List<DeviceChange>> byKey = new HashMap<>();
    private final Map<Integer, Deque<DeviceChange>> byPartition = new HashMap<>();

    /** Changes of a partition must be added in order. */
    void add(DeviceChange change) {
        byKey.computeIfAbsent(change.key(), key -> new ArrayList<>(1)).add(change);
        byPartition
                .computeIfAbsent(change.partition(), partition -> new ArrayDeque<>())
                .add(change);
    }

    /** The changes of a device, in order. */
    List<DeviceChange> of(String key) {
        return byKey.getOrDefault(key, List.of());
    }

    /** Called when the stream has reached this change, and so has passed all before it in its partition. */
    void passed(DeviceChange change) {
        Deque<DeviceChange> waiting = byPartition.getOrDefault(change.partition(), new ArrayDeque<>());
        while (!waiting.isEmpty() && waiting.peek().offset() <= change.offset()) {
            DeviceChange one = waiting.remove();
            byKey.computeIfPresent(one.key(), (key, changes) -> {
                changes.remove(one);
                return changes.isEmpty() ? null : changes;
            });
        }
    }

    /** Removes the changes of all matching devices. */
    void forget(Predicate<String> key) {
        if (byKey.keySet().removeIf(key)) {
            byPartition.values().forEach(waiting -> waiting.removeIf(change -> !byKey.containsKey(change.key())));
        }
    }

    /** The number of remaining changes. */
    int size() {
        return byPartition.values().stream().mapToInt(Deque::size).sum();
    }
}
