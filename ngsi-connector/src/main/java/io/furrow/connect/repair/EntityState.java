package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * An entity as stored in the context broker.
 *
 * @param entity only its id and type if it cannot be read; an id that is not text as JSON
 * @param time of modification or creation by which it was requested, whole milliseconds
 * @param problem why it cannot be read; empty if it can
 */
public record EntityState(Entity entity, FiwareScope scope, Instant time, Optional<UnreadableException> problem) {
    EntityState(Entity entity, FiwareScope scope, Instant time) {
        this(entity, scope, time, Optional.empty());
    }

    /** Tenant, service path, type and id. */
    String identity() {
        return scope.identity(entity.type(), entity.id());
    }

    /** The identity of this state: the entity may change twice in a millisecond. */
    String version() {
        return identity() + "|" + entity.json().hashCode();
    }
}
