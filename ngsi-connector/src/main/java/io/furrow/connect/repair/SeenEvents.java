package io.furrow.connect.repair;

import java.util.LinkedHashMap;
import java.util.Map;

/** The newest event ids, at most so many; any thread. An older one that is forgotten may be emitted once more. */
final class SeenEvents {
    private final Map<String, Boolean> ids;

    SeenEvents(int most) {
        ids = new LinkedHashMap<>() {
            private static final long serialVersionUID = 1L;

            @Override
            protected boolean removeEldestEntry(Map.Entry<String, Boolean> eldest) {
                return size() > most;
            }
        };
    }

    synchronized void add(String id) {
        ids.put(id, Boolean.TRUE);
    }

    synchronized boolean contains(String id) {
        return ids.containsKey(id);
    }
}
