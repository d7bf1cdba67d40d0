package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.util.Optional;

import org.apache.kafka.common.header.Headers;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.processor.api.RecordMetadata;

import io.furrow.kafka.KafkaClients;

/** The position of a record before repartitioning, transported in a header. */
record RecordOrigin(String topic, int partition, long offset) {
    private static final String HEADER = "request-origin";

    /** Returns the origin of the record that a processor receives from its topic. */
    static RecordOrigin of(ProcessorContext<?, ?> context) {
        RecordMetadata at = context.recordMetadata().orElseThrow();
        return new RecordOrigin(at.topic(), at.partition(), at.offset());
    }

    /** Parses the origin from the header of a record; empty if it has none. */
    static Optional<RecordOrigin> of(Record<?, ?> record) {
        return of(record.headers());
    }

    static Optional<RecordOrigin> of(Headers headers) {
        return Optional.ofNullable(KafkaClients.text(headers, HEADER)).map(RecordOrigin::parse);
    }

    private static RecordOrigin parse(String text) {
        int at = text.lastIndexOf('@');
        int dash = text.lastIndexOf('-', at);
        return new RecordOrigin(
                text.substring(0, dash),
                Integer.parseInt(text.substring(dash + 1, at)),
                Long.parseLong(text.substring(at + 1)));
    }

    /** Returns {@code <topic>-<partition>}. */
    String topicPartition() {
        return topic + "-" + partition;
    }

    <K, V> Record<K, V> addTo(Record<K, V> record) {
        record.headers().remove(HEADER);
        record.headers().add(HEADER, toString().getBytes(StandardCharsets.UTF_8));
        return record;
    }

    /** {@code <topic>-<partition>@<offset>}. */
    @Override
    public String toString() {
        return topicPartition() + "@" + offset;
    }
}
