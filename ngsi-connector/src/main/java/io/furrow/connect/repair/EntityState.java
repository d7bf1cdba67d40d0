package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;

/**
 * An entity as the context broker holds it.
 *
 * @param entity only its id and type where it cannot be read
 * @param time that it was asked for by: when it was modified or created, whole milliseconds
 * @param problem why it cannot be read, for people; empty where it can
 */
public record EntityState(Entity entity, FiwareScope scope, Instant time, Optional<String> problem) {
    EntityState(Entity entity, FiwareScope scope, Instant time) {
        this(entity, scope, time, Optional.empty());
    }

    /** Of the entity, whatever its type. */
    String identity() {
        return scope.identity(entity.id());
    }

    /** Of the entity with its type. */
    String key() {
        return identity() + "|" + entity.type();
    }

    /** Of the entity as it is: it may change twice in a millisecond. */
    String version() {
        return key() + "|" + entity.json().hashCode();
    }
}
