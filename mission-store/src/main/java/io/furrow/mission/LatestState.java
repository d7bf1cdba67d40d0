package io.furrow.mission;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;

/**
 * The last known state of each entity, folded from its events in their order: the newest value of each attribute, nothing after a
 * deletion. Holds one event per entity.
 */
public final class LatestState {
    private final Map<String, StoredEvent> byEntity = new HashMap<>();

    private LatestState() {}

    /**
     * The entities as they were known before a point, each with time, id and headers of its newest event, in the order of these.
     *
     * @param time epoch ms; events of this time are not among what was known
     * @throws RecordingInterruptedException if the thread is interrupted meanwhile
     */
    public static Collection<StoredEvent> before(Recording recording, long time, PageLimits limits)
            throws RecordingException {
        LatestState state = new LatestState();
        Cursor next = Cursor.START;
        boolean done = false;
        while (!done) {
            RecordingInterruptedException.check();
            Page page = recording.read(next, limits);
            for (StoredEvent event : page.events()) {
                if (event.time() < time) {
                    state.add(event);
                }
            }
            next = page.next();
            done = page.last() || next.time() >= time;
        }
        return state.events();
    }

    private void add(StoredEvent event) {
        String key = identity(event);
        if (event.entity() == null) {
            byEntity.remove(key);
        } else {
            byEntity.merge(key, event, LatestState::merged);
        }
    }

    private static String identity(StoredEvent event) {
        Map<String, String> headers = event.headers();
        return FiwareScope.of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH))
                .identity(event.entityId());
    }

    /** What is reported replaces what was known of the same attribute, the rest stays. */
    private static StoredEvent merged(StoredEvent known, StoredEvent newer) {
        ObjectNode entity = known.entity().objectNode();
        entity.setAll(known.entity());
        entity.setAll(newer.entity());
        return new StoredEvent(newer.id(), newer.time(), newer.entityId(), newer.headers(), entity);
    }

    private List<StoredEvent> events() {
        List<StoredEvent> events = new ArrayList<>(byEntity.values());
        events.sort(EventOrder.COMPARATOR);
        return events;
    }
}
