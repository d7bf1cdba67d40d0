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
 * Folds the events of each entity, in their order, to its last state: the newest value of each attribute, nothing after
 * a deletion. Holds one event per entity.
 */
public final class LatestState {
    private final Map<String, StoredEvent> byEntity = new HashMap<>();

    private LatestState() {}

    /** Returns the states after these ordered events. */
    public static List<StoredEvent> of(Collection<StoredEvent> events) {
        LatestState state = new LatestState();
        events.forEach(state::add);
        return state.events();
    }

    /** Computes {@link Recording#stateBefore} by reading the recording from its beginning. */
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
                    .removeIf(older -> older.entityId().equals(event.entityId())
                            && scope(older).equals(scope(event)));
        } else {
            byEntity.remove(identity(event));
        }
    }

    /** Returns whether two events of one id may be of one entity; a deletion without a type applies to all types. */
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

    /** Returns the entity's type; empty for a deletion without one. */
    private static String type(StoredEvent event) {
        return event.entity() == null
                ? event.headers().getOrDefault(HeaderNames.ENTITY_TYPE, "")
                : event.entity().path("type").asText();
    }

    /** Replaces the attributes that the newer event has. */
    private static StoredEvent merged(StoredEvent older, StoredEvent newer) {
        ObjectNode entity = older.entity().objectNode();
        entity.setAll(older.entity());
        entity.setAll(newer.entity());
        return new StoredEvent(newer.id(), newer.time(), newer.entityId(), newer.headers(), entity);
    }

    private List<StoredEvent> events() {
        List<StoredEvent> events = new ArrayList<>(byEntity.values());
        events.sort(EventOrder.COMPARATOR);
        return events;
    }
}
