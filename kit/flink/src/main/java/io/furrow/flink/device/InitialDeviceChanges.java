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

    /** In the order of each partition. */
    void add(DeviceChange change) {
        byKey.computeIfAbsent(change.key(), key -> new ArrayList<>(1)).add(change);
        byPartition
                .computeIfAbsent(change.partition(), partition -> new ArrayDeque<>())
                .add(change);
    }

    /** Those of a device, in their order. */
    List<DeviceChange> of(String key) {
        return byKey.getOrDefault(key, List.of());
    }

    /** The stream has come to this change: all before it in its partition came before. */
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

    /** Forgets the changes of all devices of which this is so. */
    void forget(Predicate<String> key) {
        if (byKey.keySet().removeIf(key)) {
            byPartition.values().forEach(waiting -> waiting.removeIf(change -> !byKey.containsKey(change.key())));
        }
    }

    /** How many changes there still are. */
    int size() {
        return byPartition.values().stream().mapToInt(Deque::size).sum();
    }
}
