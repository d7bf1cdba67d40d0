package io.furrow.ingest.route;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The entity of the event that a task handles. The stages behind each other in a task see an event one after the other, on one
 * thread: the first one that asks has it parsed, for all of them.
 */
public final class EventEntity {
    private static final ThreadLocal<EventEntity> NEWEST = new ThreadLocal<>();

    private final byte[] bytes;
    private final SlicedEntity entity;

    private EventEntity(byte[] bytes) throws UnreadableException {
        this.bytes = bytes;
        this.entity = SlicedEntity.parse(bytes);
    }

    /**
     * The entity that the record has as its value; not to be changed.
     *
     * @throws UnreadableException as {@link SlicedEntity#parse}
     */
    public static SlicedEntity of(TopicRecord record) throws UnreadableException {
        EventEntity newest = NEWEST.get();
        if (newest == null || newest.bytes != record.value()) {
            newest = new EventEntity(record.value());
            NEWEST.set(newest);
        }
        return newest.entity;
    }
}
