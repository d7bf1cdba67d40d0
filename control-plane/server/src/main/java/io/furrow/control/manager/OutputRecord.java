package io.furrow.control.manager;

import org.apache.kafka.common.serialization.Serde;
import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Produced;

/**
 * A record on its way out of a manager.
 *
 * @param value null deletes what has the key
 */
public record OutputRecord(String topic, byte[] value) {
    private static final Serde<OutputRecord> SERDE =
            Serdes.serdeFrom((topic, outgoing) -> outgoing.value(), (topic, bytes) -> new OutputRecord(topic, bytes));

    /** Sends each to its topic. */
    public static void send(KStream<String, OutputRecord> stream, String name) {
        stream.to(
                (key, outgoing, context) -> outgoing.topic(),
                Produced.with(Serdes.String(), SERDE).withName(name));
    }
}
