package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.ngsi.UnreadableException;

/** Receives the records of other parts of Furrow. */
public interface Observer {
    /**
     * @param record its key may be empty; its value is null for a deletion
     * @param now epoch ms
     */
    void take(Record<String, byte[]> record, long now) throws UnreadableException;

    /** Called about once a second. */
    default void passTime(long now) {}

    /** Receives the statuses that hosts and players report; skips records without a key or a value. */
    interface OfStatuses extends Observer {
        /** @param now epoch ms */
        void take(String key, byte[] status, long now) throws UnreadableException;

        @Override
        default void take(Record<String, byte[]> record, long now) throws UnreadableException {
            if (record.key() != null && record.value() != null) {
                take(record.key(), record.value(), now);
            }
        }
    }
}
