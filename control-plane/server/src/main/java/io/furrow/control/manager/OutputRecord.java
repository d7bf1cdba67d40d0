package io.furrow.control.manager;

import org.apache.kafka.common.serialization.Serde;
import org.apache.kafka.common.serialization.Serdes;

/**
 * A record to be written to a topic.
 *
 * @param value null for a tombstone
 */
public record OutputRecord(String topic, byte[] value) {
    static final Serde<OutputRecord> SERDE =
            Serdes.serdeFrom((topic, outgoing) -> outgoing.value(), (topic, bytes) -> new OutputRecord(topic, bytes));
}
