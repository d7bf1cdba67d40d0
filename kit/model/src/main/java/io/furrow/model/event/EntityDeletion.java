package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.time.Instants;

/**
 * The deletion of an entity as a source emits it: key = the entity's id, no value, record timestamp = {@code time},
 * headers = {@link #headers(String)}.
 *
 * @param type of the entity; empty if unknown, which deletes all entities of the id
 * @param time when the entity was deleted if the context broker reports it, otherwise when the source received the
 * deletion; whole milliseconds. Never the time of the entity's last values, because the deletion is newer
 * @param received when the source received the deletion
 */
public record EntityDeletion(
        String type, String entityId, FiwareScope scope, Instant time, Instant received, Origin origin) {
    /** Truncates the time to whole milliseconds, the precision of record timestamps, so that all copies of it agree. */
    public EntityDeletion {
        time = time.truncatedTo(ChronoUnit.MILLIS);
    }

    /** Returns the deletion that an entity with {@link Entity#isDeleted()} reports. */
    public static EntityDeletion of(
            Entity deleted, FiwareScope scope, Instant received, Duration maxSkew, Origin origin) {
        Instant time = deleted.value("deletedAt")
                .flatMap(Instants::of)
                .filter(at -> !at.isAfter(received.plus(maxSkew)))
                .orElse(received);
        return new EntityDeletion(deleted.type(), deleted.id(), scope, time, received, origin);
    }

    /** Returns an id that is equal for all copies of the deletion and differs from those of all changes. */
    public String id() {
        return EventId.ofDeletion(scope, type, entityId, time);
    }

    /** Returns the headers of {@link HeaderNames} in a fixed order; {@code source} becomes {@code ce_source}. */
    public Map<String, String> headers(String source) {
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(HeaderNames.CE_ID, id());
        headers.put(HeaderNames.CE_SOURCE, source);
        headers.put(HeaderNames.CE_TIME, time.toString());
        headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_DELETED);
        headers.put(HeaderNames.SERVICE, scope.service());
        headers.put(HeaderNames.SERVICE_PATH, scope.servicePath());
        if (!type.isEmpty()) {
            headers.put(HeaderNames.ENTITY_TYPE, type);
        }
        headers.put(HeaderNames.ORIGIN, origin.code());
        headers.put(HeaderNames.TS_DEVICE, Long.toString(time.toEpochMilli()));
        headers.put(HeaderNames.TS_SOURCE, Long.toString(received.toEpochMilli()));
        return headers;
    }
}
