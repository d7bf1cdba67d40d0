package io.furrow.control.replay;

import java.io.IOException;
import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import io.furrow.model.control.RecordedMission;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Computes the changes of {@code service.recordings}. A new mission is read at each poll until it has an event, and
 * then at most every {@link #SPAN_INTERVAL} by any instance.
 */
final class RecordingList {
    static final Duration SPAN_INTERVAL = Duration.ofSeconds(30);

    private final Map<String, RecordedMission> listed = new HashMap<>();
    /** When each mission was last read, epoch ms. */
    private final Map<String, Long> polled = new HashMap<>();

    interface Store {
        /** Returns the names that commands accept. */
        List<String> names() throws IOException;

        /** Returns a recording; empty if it has no event. */
        Optional<RecordedMission> find(String name) throws IOException;
    }

    /** Processes a record of the topic. @param value null if the mission was deleted */
    void take(String mission, byte[] value, long timestamp) {
        listed.remove(mission);
        if (value == null) {
            polled.remove(mission);
            return;
        }
        try {
            listed.put(mission, RecordedMission.read(value));
            polled.merge(mission, timestamp, Math::max);
        } catch (UnreadableException e) {
            polled.remove(mission); // it is written again
        }
    }

    /**
     * Returns the records to write.
     *
     * @param now epoch ms
     * @return recordings by mission; empty for a deleted mission
     */
    Map<String, Optional<RecordedMission>> changes(Store store, long now) throws IOException {
        List<String> names = store.names();
        Map<String, Optional<RecordedMission>> changes = new LinkedHashMap<>();
        for (String name : names) {
            if (now - polled.getOrDefault(name, Long.MIN_VALUE / 2) < SPAN_INTERVAL.toMillis()) {
                continue;
            }
            Optional<RecordedMission> found = store.find(name);
            if (found.isPresent()) {
                polled.put(name, now);
            }
            if (!found.equals(Optional.ofNullable(listed.get(name)))) {
                changes.put(name, found);
            }
        }
        listed.keySet().stream()
                .filter(name -> !names.contains(name))
                .forEach(name -> changes.put(name, Optional.empty()));
        polled.keySet().retainAll(names);
        return changes;
    }

    int size() {
        return listed.size();
    }
}
