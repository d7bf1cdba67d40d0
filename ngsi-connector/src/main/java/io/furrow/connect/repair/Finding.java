package io.furrow.connect.repair;

import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;

/** What the source may not have been told. */
public sealed interface Finding {
    /** An entity as it is now. */
    record Changed(EntityEvent event) implements Finding {
        @Override
        public String identity() {
            return event.scope().identity(event.entity().id());
        }
    }

    /** An entity that is gone. */
    record Deleted(EntityDeletion deletion) implements Finding {
        @Override
        public String identity() {
            return deletion.scope().identity(deletion.entityId());
        }
    }

    /** Tenant, service path and id. */
    String identity();
}
