package io.furrow.control.rest;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Writes dead letters to topics and reads what they hold. */
final class DeadLetterTopics implements AutoCloseable {
    /** Not long ago: the broker's retention goes by the record timestamp. */
    static final long TIME = System.currentTimeMillis() - 60_000;

    private final Properties client;
    private final KafkaProducer<byte[], byte[]> producer;

    /** @param client settings of a Kafka client */
    DeadLetterTopics(Properties client) {
        this.client = client;
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("max.request.size", 4_000_000);
        producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }

    @Override
    public void close() {
        producer.close();
    }

    void send(String topic, long time, byte[] value, String stage, String source) {
        deadLetter(topic, time, "k", value, new DeadLetter(Reason.NOT_JSON, "why", stage, source).headers());
    }

    /** The broker creates a topic whose partitions are requested. */
    void create(String topic) {
        producer.partitionsFor(topic);
    }

    /** Where the record is afterwards. */
    OriginalReference place(String topic, String key, byte[] value, Map<String, String> headers) {
        deadLetter(topic, key, value, headers);
        return recordsOf(topic).stream()
                .filter(record -> Arrays.equals(record.value(), value))
                .map(record -> new OriginalReference(topic, record.partition(), record.offset(), value.length))
                .findFirst()
                .orElseThrow();
    }

    void standIn(String topic, String key, OriginalReference original) {
        deadLetter(topic, key, new byte[] {0}, Reason.NOT_JSON, "why", original.headers());
    }

    void deadLetterOf(String stage, String topic, int value, Reason reason) {
        deadLetter(topic, "k", new byte[] {(byte) value}, new DeadLetter(reason, "why", stage, "t-0@0").headers());
    }

    void deadLetter(String topic, String key, byte[] value, Reason reason, String message, Map<String, String> own) {
        Map<String, String> headers = new TreeMap<>(own);
        headers.putAll(new DeadLetter(reason, message, "test", "t-0@0").headers());
        deadLetter(topic, key, value, headers);
    }

    void deadLetter(String topic, String key, byte[] value, Map<String, String> headers) {
        deadLetter(topic, TIME, key, value, headers);
    }

    void deadLetter(String topic, long time, String key, byte[] value, Map<String, String> headers) {
        byte[] keyBytes = key == null ? null : key.getBytes(UTF_8);
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(topic, null, time, keyBytes, value);
        headers.forEach((name, text) -> record.headers().add(name, text.getBytes(UTF_8)));
        try {
            Topics.ofDeadLetters(topic).ifPresent(producer::partitionsFor);
            producer.send(record).get();
        } catch (InterruptedException | ExecutionException e) {
            throw new AssertionError(e);
        }
    }

    /** Also those whose transaction is committed, though its marker may still be on the way. */
    List<ConsumerRecord<byte[], byte[]>> recordsOf(String topic) {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("auto.offset.reset", "earliest");
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            consumer.assign(consumer.partitionsFor(topic).stream()
                    .map(partition -> new TopicPartition(topic, partition.partition()))
                    .toList());
            Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment());
            while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
                consumer.poll(Duration.ofMillis(100)).forEach(records::add);
            }
        }
        return records;
    }

    static Map<String, String> headers(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new TreeMap<>();
        record.headers().forEach(header -> headers.put(header.key(), new String(header.value(), UTF_8)));
        return headers;
    }
}
