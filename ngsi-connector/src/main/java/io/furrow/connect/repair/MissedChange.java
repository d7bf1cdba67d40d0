package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.ngsi.UnreadableException;

/** A change of which the source may have missed the notification. */
public sealed interface MissedChange {
    /** The current state of an entity. */
    record Changed(EntityEvent event, TrackedRecord record) implements MissedChange {
        /** @param modified when the context broker stored it */
        static Changed of(EntityEvent event, Instant modified) {
            String identity =
                    event.scope().identity(event.entity().type(), event.entity().id());
            return new Changed(event, new TrackedRecord(identity, event.id(), Optional.of(modified), false));
        }
    }

    /** A deleted entity. */
    record Deleted(EntityDeletion deletion) implements MissedChange {
        @Override
        public TrackedRecord record() {
            String identity = deletion.scope().identity(deletion.type(), deletion.entityId());
            return new TrackedRecord(identity, deletion.id(), Optional.empty(), true);
        }
    }

    /** An entity in the context broker that cannot be read. */
    record Unreadable(EntityState state, Instant received) implements MissedChange {
        @Override
        public TrackedRecord record() {
            String eventId = "unreadable " + state.time().toEpochMilli();
            return new TrackedRecord(state.identity(), eventId, Optional.of(state.time()), false);
        }

        public String entityId() {
            return state.entity().id();
        }

        public UnreadableException problem() {
            return state.problem().orElseThrow();
        }
    }

    /** The properties of the resulting record. */
    TrackedRecord record();

    /** Tenant, service path, type and id. */
    default String identity() {
        return record().identity();
    }
}
