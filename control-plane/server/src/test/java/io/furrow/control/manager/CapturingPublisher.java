package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** Captures written records: all of them, and the compacted state. */
public final class CapturingPublisher implements EventPublisher {
    private final List<Written> all = new ArrayList<>();
    private final Map<String, Map<String, byte[]>> compacted = new TreeMap<>();

    public record Written(String topic, String key, byte[] value) {}

    @Override
    public void put(String topic, String key, byte[] value) {
        all.add(new Written(topic, key, value));
        if (value == null) {
            compacted(topic).remove(key);
        } else {
            compacted(topic).put(key, value);
        }
    }

    public List<Written> all() {
        return all;
    }

    public Map<String, byte[]> compacted(String topic) {
        return compacted.computeIfAbsent(topic, name -> new TreeMap<>());
    }
}
