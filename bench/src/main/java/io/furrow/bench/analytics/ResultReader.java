package io.furrow.bench.analytics;

import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.frame.TopicReader;

/** Follows event time in the topic of results. */
final class ResultReader implements AutoCloseable {
    private final TopicReader reader;
    private volatile long newest = Long.MIN_VALUE;
    private volatile long count;

    ResultReader(Properties kafka, String topic) {
        reader = TopicReader.fromBeginning(kafka, Map.of(), topic).follow(records -> records.forEach(this::take));
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread reads
    private void take(ConsumerRecord<byte[], byte[]> record) {
        newest = Math.max(newest, record.timestamp());
        count++;
    }

    /** Event time of the newest result; {@code Long.MIN_VALUE} before the first. */
    long newest() {
        return newest;
    }

    long count() {
        return count;
    }

    @Override
    public void close() {
        reader.close();
    }
}
