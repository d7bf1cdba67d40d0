package io.furrow.connect.sink;

import java.util.Objects;

import io.furrow.model.ngsi.Entity;

/**
 * What one record says of one entity.
 *
 * @param entity null for a deletion
 * @param time event time in epoch milliseconds, {@link #NO_TIME} where the record has none
 * @param source the number of the record in its delivery
 */
record Change(EntityKey key, Entity entity, long time, int source) {
    /** Older than all times: what has no time of its own never takes the place of what has. */
    static final long NO_TIME = Long.MIN_VALUE;

    Change {
        Objects.requireNonNull(key);
    }

    boolean isDeletion() {
        return entity == null;
    }
}
