package io.furrow.flink.kafka;

import java.io.IOException;
import java.io.Serializable;
import java.util.List;

import io.furrow.flink.record.TopicRecord;

/**
 * The content of a topic at the moment of the call. An operator that joins events with the topic's records reads it before
 * its first event, also after each restart; later records reach it as a broadcast stream, which repeats the same records
 * first.
 */
public interface TopicSnapshot extends Serializable {
    /** For a job that does not read the topic. */
    TopicSnapshot NONE = List::of;

    /** In the topic's order: by offset within each partition. */
    List<TopicRecord> read() throws IOException;

    /** Receives one record at a time. */
    interface Taker<E extends Exception> {
        void take(TopicRecord record) throws E;
    }

    /** The same one by one, for a topic that need not fit into memory. */
    default <E extends Exception> void forEach(Taker<E> taker) throws IOException, E {
        for (TopicRecord record : read()) {
            taker.take(record);
        }
    }
}
