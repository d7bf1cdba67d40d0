package io.furrow.ingest.route;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Shares the parsed entity of an event among the chained stages of a task, which process it in sequence on one thread: it is
 * parsed on first use.
 */
public final class EventEntity {
    private static final int THREADS = 64;
    /** By thread, without the lookup of a thread local; threads that share a slot parse separately. */
    private static final EventEntity[] NEWEST = new EventEntity[THREADS];

    private final byte[] bytes;
    private final SlicedEntity entity;

    private EventEntity(byte[] bytes) throws UnreadableException {
        this.bytes = bytes;
        this.entity = SlicedEntity.ofChecked(bytes);
    }

    /** The entity in the record's value, which {@link ParseEvents} has validated. */
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
