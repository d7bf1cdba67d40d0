package io.furrow.mission;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

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

    /** Of these events, which come in their order. */
    public static List<StoredEvent> of(Collection<StoredEvent> events) {
        LatestState state = new LatestState();
        events.forEach(state::add);
        return state.events();
    }

    /** As {@link Recording#stateBefore}, read from the recording's beginning. */
    static List<StoredEvent> before(Recording recording, long time, Set<String> entities, PageLimits limits)
            throws RecordingException {
        LatestState state = new LatestState();
        Cursor next = Cursor.START;
        boolean done = false;
        while (!done) {
            RecordingInterruptedException.check();
            EventPage eventPage = recording.read(next, limits);
            for (StoredEvent event : eventPage.events()) {
                if (event.time() < time && (entities.isEmpty() || entities.contains(event.entityId()))) {
                    state.add(event);
                }
            }
            next = eventPage.next();
            done = eventPage.last() || next.time() >= time;
        }
        return state.events();
    }

    private void add(StoredEvent event) {
        if (event.entity() != null) {
            byEntity.merge(identity(event), event, LatestState::merged);
        } else if (type(event).isEmpty()) {
            byEntity.values()
                    .removeIf(known -> known.entityId().equals(event.entityId())
                            && scope(known).equals(scope(event)));
        } else {
            byEntity.remove(identity(event));
        }
    }

    /** Whether two events of one id may be of one entity; a deletion that names no type is of all. */
    public static boolean isOfOneEntity(StoredEvent one, StoredEvent other) {
        boolean oneType =
                type(one).isEmpty() || type(other).isEmpty() || type(one).equals(type(other));
        return oneType && scope(one).equals(scope(other));
    }

    private static String identity(StoredEvent event) {
        return scope(event).identity(type(event), event.entityId());
    }

    private static FiwareScope scope(StoredEvent event) {
        return FiwareScope.of(event.headers());
    }

    /** Empty for a deletion that does not name it. */
    private static String type(StoredEvent event) {
        return event.entity() == null
                ? event.headers().getOrDefault(HeaderNames.ENTITY_TYPE, "")
                : event.entity().path("type").asText();
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
