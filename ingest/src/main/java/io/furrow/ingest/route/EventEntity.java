package io.furrow.ingest.route;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The entity of the event that a task handles. The stages behind each other in a task see an event one after the other, on one
 * thread: the first one that asks has it parsed, for all of them.
 */
public final class EventEntity {
    private static final int THREADS = 64;
    /** By thread, without the search of a thread local; where two share a place, each parses for itself. */
    private static final EventEntity[] NEWEST = new EventEntity[THREADS];

    private final byte[] bytes;
    private final SlicedEntity entity;

    private EventEntity(byte[] bytes) throws UnreadableException {
        this.bytes = bytes;
        this.entity = SlicedEntity.ofChecked(bytes);
    }

    /** The entity that the record has as its value, which {@link ParseEvents} has looked at. */
    public static SlicedEntity of(TopicRecord record) throws UnreadableException {
        int place = (int) (Thread.currentThread().getId() % THREADS);
        EventEntity newest = NEWEST[place];
        if (newest == null || newest.bytes != record.value()) {
            newest = new EventEntity(record.value());
            NEWEST[place] = newest;
        }
        return newest.entity;
    }
}
