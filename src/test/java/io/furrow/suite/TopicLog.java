package io.furrow.suite;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.kafka.CommittedReader;
import io.furrow.launcher.suite.Suite;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Reads a topic from its beginning; each call returns all records up to then. */
final class TopicLog implements AutoCloseable {
    private final CommittedReader<byte[]> reader;
    private final String topic;
    private final List<ConsumerRecord<byte[], byte[]>> seen = new ArrayList<>();

    TopicLog(Suite suite, String topic) {
        this.reader = CommittedReader.openBytes(suite.kafka().clientProperties(), topic);
        this.topic = topic;
    }

    List<ConsumerRecord<byte[], byte[]>> records() {
        reader.assign(List.of(topic));
        reader.readToEnd(seen::add);
        return List.copyOf(seen);
    }

    /** The records of one entity. */
    List<ConsumerRecord<byte[], byte[]>> of(String entityId) {
        return records().stream()
                .filter(record -> entityId.equals(new String(record.key(), UTF_8)))
                .toList();
    }

    static Map<String, String> headers(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new HashMap<>();
        record.headers().forEach(header -> headers.put(header.key(), new String(header.value(), UTF_8)));
        return headers;
    }

    @Override
    public void close() {
        reader.close();
    }
}
