package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.time.Instants;

/**
 * The state of an entity that a record holds.
 *
 * @param type of the entity
 * @param modified {@code dateModified} by the context broker's clock; empty if not reported
 */
public record EntityVersion(String type, Optional<Instant> modified) {
    public static EntityVersion of(Entity entity) {
        return new EntityVersion(entity.type(), entity.value("dateModified").flatMap(Instants::of));
    }
}
