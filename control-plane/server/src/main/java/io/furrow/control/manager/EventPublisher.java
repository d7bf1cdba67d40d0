package io.furrow.control.manager;

/** Receives the records that a manager writes; those of one request become visible together. */
public interface EventPublisher {
    /** @param value null for a tombstone */
    void put(String topic, String key, byte[] value);
}
