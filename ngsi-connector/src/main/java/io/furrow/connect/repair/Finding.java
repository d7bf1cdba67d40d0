package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;

/** What the source may not have been told. */
public sealed interface Finding {
    /** An entity as it is now. */
    record Changed(EntityEvent event, EntityRecord record) implements Finding {
        /** @param modified when the context broker stored it */
        static Changed of(EntityEvent event, Instant modified) {
            String identity = event.scope().identity(event.entity().id());
            Optional<String> type = Optional.of(event.entity().type());
            return new Changed(event, new EntityRecord(identity, type, event.id(), Optional.of(modified), false));
        }
    }

    /** An entity that is gone. */
    record Deleted(EntityDeletion deletion) implements Finding {
        @Override
        public EntityRecord record() {
            String identity = deletion.scope().identity(deletion.entityId());
            return new EntityRecord(identity, Optional.empty(), deletion.id(), Optional.empty(), true);
        }
    }

    /** An entity that the context broker has and that cannot be read. */
    record Unreadable(EntityState state, Instant received) implements Finding {
        @Override
        public EntityRecord record() {
            String eventId = "unreadable " + state.time().toEpochMilli();
            return new EntityRecord(
                    state.identity(), Optional.of(state.entity().type()), eventId, Optional.of(state.time()), false);
        }

        public String entityId() {
            return state.entity().id();
        }

        /** Why, for people. */
        public String problem() {
            return state.problem().orElse("");
        }
    }

    /** The record that it becomes. */
    EntityRecord record();

    /** Tenant, service path and id. */
    default String identity() {
        return record().identity();
    }
}
