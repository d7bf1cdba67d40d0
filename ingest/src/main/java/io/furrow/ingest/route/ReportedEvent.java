package io.furrow.ingest.route;

import java.time.Instant;
import java.util.Map;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;

/**
 * An event in the stages of {@code ingest}: a change of an entity, or its deletion.
 *
 * @param id event id
 * @param identity tenant, service path and entity id: the key of all state, in which entities of several types are
 *     distinguished
 * @param entityId id of the entity
 * @param type type of the entity; empty for a deletion without one, which deletes all entities of the id
 * @param domain empty if there is none
 * @param mission empty if there is none
 * @param record as read; with a null value for a deletion
 */
public record ReportedEvent(
        String id, String identity, String entityId, String type, String domain, String mission, TopicRecord record) {
    /** Whether this deletes the entity. */
    public boolean isDeletion() {
        return record.value() == null;
    }

    /** Event time, epoch ms. */
    public long time() {
        return record.timestamp();
    }

    /** When the source received it, epoch ms; its event time if unknown. */
    public long received() {
        String received = record.headers().get(HeaderNames.TS_SOURCE);
        try {
            return received == null ? time() : Long.parseLong(received);
        } catch (NumberFormatException e) { // another producer's header
            return time();
        }
    }

    /** The same event with its domain and mission. */
    public ReportedEvent belongingTo(String itsDomain, String itsMission) {
        return new ReportedEvent(id, identity, entityId, type, itsDomain, itsMission, record);
    }

    /** For a deletion of all entities of an id: the deletion of the one of this type. */
    ReportedEvent deletionOf(String its) {
        Map<String, String> headers = record.headers();
        FiwareScope scope = FiwareScope.of(headers);
        Instant time = Instant.ofEpochMilli(time());
        String itsId = new EntityDeletion(its, entityId, scope, time, time, Origin.KAFKA).id();
        TopicRecord deletion = record.with(Map.of(HeaderNames.CE_ID, itsId, HeaderNames.ENTITY_TYPE, its));
        return new ReportedEvent(itsId, identity, entityId, its, domain, mission, deletion);
    }

    /** The same event with another record, for instance with a reference instead of an image. */
    public ReportedEvent as(TopicRecord other) {
        return new ReportedEvent(id, identity, entityId, type, domain, mission, other);
    }
}
