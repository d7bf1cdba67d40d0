package io.furrow.connect.sink.api;

import java.util.Objects;

import io.furrow.model.ngsi.Entity;

/**
 * A change of one entity by one record.
 *
 * @param type of the entity; empty for a deletion of all types with the id
 * @param entity null for a deletion
 * @param time event time in epoch milliseconds, {@link #NO_TIME} if the record has none
 * @param source the index of the record in its delivery
 */
public record EntityChange(EntityKey key, String type, Entity entity, long time, int source) {
    /** Older than all times: a value without a time never replaces one with a time. */
    public static final long NO_TIME = Long.MIN_VALUE;

    public EntityChange {
        Objects.requireNonNull(key);
        Objects.requireNonNull(type);
    }

    boolean isDeletion() {
        return entity == null;
    }

    /** Whether a deletion is of an entity of this type, too. */
    boolean deletes(String entityType) {
        return isDeletion() && (type.isEmpty() || type.equals(entityType));
    }
}
