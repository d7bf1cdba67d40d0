package io.furrow.control.manager;

/** Takes what a manager writes; all of one request becomes visible together. */
public interface Outbox {
    /** @param value null deletes what has the key */
    void put(String topic, String key, byte[] value);
}
