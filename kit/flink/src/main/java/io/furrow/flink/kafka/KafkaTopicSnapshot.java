package io.furrow.flink.kafka;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.common.KafkaException;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TextHeaders;
import io.furrow.flink.record.TopicRecord;
import io.furrow.kafka.CommittedReader;

/**
 * Reads the topic from its beginning to the end offsets at the start of the read; a missing topic has no records. Operators of
 * one process that read the same topic at the same time share one read. A read takes as long as records arrive; it fails when
 * the broker returned nothing for {@code default.api.timeout.ms} of the Kafka properties, by default a minute.
 */
public final class KafkaTopicSnapshot implements TopicSnapshot {
    private static final long serialVersionUID = 1L;
    private static final SharedReads<Properties, List<TopicRecord>> UNDER_WAY = new SharedReads<>();

    private final Properties client;
    private final String topic;

    public KafkaTopicSnapshot(JobOptions options, String topic) {
        this.topic = topic;
        this.client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
    }

    @Override
    public List<TopicRecord> read() throws IOException {
        Properties same = (Properties) client.clone();
        same.setProperty("topic", topic);
        return UNDER_WAY.join(same, () -> {
            List<TopicRecord> records = new ArrayList<>();
            forEach(records::add);
            return List.copyOf(records);
        });
    }

    @Override
    public <E extends Exception> void forEach(Taker<E> taker) throws IOException, E {
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(client, topic)) {
            reader.<E>readToEnd(record -> taker.take(new TopicRecord(
                    topic,
                    record.partition(),
                    record.offset(),
                    record.timestamp(),
                    record.key(),
                    record.value(),
                    TextHeaders.of(record.headers().toArray()))));
        } catch (KafkaException e) {
            throw new IOException(
                    "topic " + topic + " could not be read; does its broker respond? It may take the time that "
                            + ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG + " in --kafka-properties says",
                    e);
        }
    }
}
