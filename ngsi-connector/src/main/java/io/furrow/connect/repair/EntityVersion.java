package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Instants;

/**
 * Which state of an entity a record tells.
 *
 * @param type of the entity
 * @param modified {@code dateModified} by the context broker's clock; empty where it does not tell
 */
public record EntityVersion(String type, Optional<Instant> modified) {
    public static EntityVersion of(Entity entity) {
        return new EntityVersion(entity.type(), entity.value("dateModified").flatMap(Instants::of));
    }
}
