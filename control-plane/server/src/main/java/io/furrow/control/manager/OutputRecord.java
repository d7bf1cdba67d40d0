package io.furrow.control.manager;

import org.apache.kafka.common.serialization.Serde;
import org.apache.kafka.common.serialization.Serdes;

/**
 * A record on its way out of a manager.
 *
 * @param value null deletes what has the key
 */
public record OutputRecord(String topic, byte[] value) {
    static final Serde<OutputRecord> SERDE =
            Serdes.serdeFrom((topic, outgoing) -> outgoing.value(), (topic, bytes) -> new OutputRecord(topic, bytes));
}
