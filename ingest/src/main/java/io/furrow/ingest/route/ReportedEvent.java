package io.furrow.ingest.route;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;

/**
 * An event as the stages of {@code ingest} see it: a change of an entity, or its deletion.
 *
 * @param id event id
 * @param identity tenant, service path and entity id; the key of all state
 * @param entityId id of the entity
 * @param type type of the entity; empty for a deletion, which does not name it
 * @param domain empty if there is none
 * @param mission empty if there is none
 * @param record as it was read; null as its value for a deletion
 */
public record ReportedEvent(
        String id, String identity, String entityId, String type, String domain, String mission, TopicRecord record) {
    /** Whether this is the end of the entity. */
    public boolean isDeletion() {
        return record.value() == null;
    }

    /** Event time, epoch ms. */
    public long time() {
        return record.timestamp();
    }

    /** When the source received it, epoch ms; its event time if that is not said. */
    public long received() {
        String received = record.headers().get(HeaderNames.TS_SOURCE);
        try {
            return received == null ? time() : Long.parseLong(received);
        } catch (NumberFormatException e) { // a stranger's header
            return time();
        }
    }

    /** The same event with what was found out of its domain and mission. */
    public ReportedEvent belongingTo(String itsDomain, String itsMission) {
        return new ReportedEvent(id, identity, entityId, type, itsDomain, itsMission, record);
    }

    /** The same event as another record, for instance with a reference where an image was. */
    public ReportedEvent as(TopicRecord other) {
        return new ReportedEvent(id, identity, entityId, type, domain, mission, other);
    }
}
