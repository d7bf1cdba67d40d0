package io.furrow.flink.kafka;

import java.io.IOException;
import java.io.Serializable;
import java.util.List;

import io.furrow.flink.record.TopicRecord;

/**
 * What is on a topic at the moment of the call. An operator that joins events with the topic's records reads it before its
 * first event, here and after each restart; what comes later reaches it as a broadcast stream, which begins with the same
 * records again.
 */
public interface TopicSnapshot extends Serializable {
    /** For a job that does not look at the topic. */
    TopicSnapshot NONE = List::of;

    /** In the order of the topic, as far as it has one: by offset within each partition. */
    List<TopicRecord> read() throws IOException;

    /** Takes one record after the other. */
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
