package io.furrow.launcher.dead;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.TreeMap;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerGroupMetadata;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.model.event.DeadLetter;

/**
 * Brings dead letters back to a topic as they were: key, bytes, time and headers, without those that say why they were set
 * aside. What is written and how far was read are one transaction, so that no letter is fed twice by the same group. Reads up
 * to the end that the topic had at the beginning: a letter that dies again waits for the next time.
 */
public final class Refeed {
    private static final Duration PATIENCE = Duration.ofSeconds(30);
    private static final Set<String> ADDED =
            Set.of(DeadLetter.REASON, DeadLetter.MESSAGE, DeadLetter.STAGE, DeadLetter.SOURCE);
    private static final String OTHER = "no dead letter";
    private static final String TRUNCATED = "truncated";

    /**
     * What is wanted.
     *
     * @param from topic of the dead letters
     * @param to topic to which they go
     * @param reasons those wanted; empty for all
     * @param again whether those are fed again that were fed before
     * @param dryRun whether they are only counted
     */
    public record Wish(String from, String to, Set<String> reasons, boolean again, boolean dryRun) {
        /** Each choice of reasons has its own memory of what was fed. */
        String group() {
            String chosen = reasons.isEmpty() ? "" : "-" + String.join("-", new java.util.TreeSet<>(reasons));
            return "furrow-refeed-" + from + "-" + to + chosen;
        }
    }

    /** How many were fed, by reason, and how many stayed, by why they did. */
    public record Outcome(Map<String, Long> fed, Map<String, Long> left) {
        public long total() {
            return fed.values().stream().mapToLong(Long::longValue).sum();
        }
    }

    private final Properties kafka;
    private final Wish wish;
    private final Map<String, Long> fed = new TreeMap<>();
    private final Map<String, Long> left = new TreeMap<>();

    /** @param kafka what every client needs, {@code bootstrap.servers} at least */
    public Refeed(Properties kafka, Wish wish) {
        this.kafka = kafka;
        this.wish = wish;
    }

    /** @throws IOException if the topic is not there, or its end is not reached */
    public Outcome run() throws IOException {
        try (var consumer = consumer();
                var producer = wish.dryRun() ? null : producer()) {
            assign(consumer);
            Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment(), PATIENCE);
            if (producer != null) {
                producer.initTransactions();
            }
            long until = System.nanoTime() + PATIENCE.toNanos();
            while (isBehind(consumer, ends)) {
                ConsumerRecords<byte[], byte[]> records = consumer.poll(Duration.ofMillis(200));
                if (!records.isEmpty()) {
                    feed(records, ends, producer, consumer.groupMetadata());
                    until = System.nanoTime() + PATIENCE.toNanos();
                } else if (System.nanoTime() > until) {
                    throw new IOException("the end of " + wish.from() + " was not reached; does its broker answer?");
                }
            }
            return new Outcome(fed, left);
        }
    }

    private void assign(KafkaConsumer<byte[], byte[]> consumer) throws IOException {
        List<PartitionInfo> partitions = consumer.partitionsFor(wish.from(), PATIENCE);
        if (partitions == null || partitions.isEmpty()) {
            throw new IOException("there is no topic " + wish.from() + "; name another with --topic");
        }
        consumer.assign(partitions.stream()
                .map(partition -> new TopicPartition(wish.from(), partition.partition()))
                .toList());
        if (wish.again()) {
            consumer.seekToBeginning(consumer.assignment());
        }
    }

    private static boolean isBehind(KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> ends) {
        return ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue());
    }

    private void feed(
            ConsumerRecords<byte[], byte[]> records,
            Map<TopicPartition, Long> ends,
            KafkaProducer<byte[], byte[]> producer,
            ConsumerGroupMetadata group) {
        Map<TopicPartition, OffsetAndMetadata> done = new HashMap<>();
        if (producer != null) {
            producer.beginTransaction();
        }
        for (ConsumerRecord<byte[], byte[]> letter : records) {
            TopicPartition partition = new TopicPartition(letter.topic(), letter.partition());
            if (letter.offset() >= ends.get(partition)) {
                continue;
            }
            done.put(partition, new OffsetAndMetadata(letter.offset() + 1));
            if (isWanted(letter) && producer != null) {
                producer.send(original(letter));
            }
        }
        if (producer != null) {
            producer.sendOffsetsToTransaction(done, group);
            producer.commitTransaction();
        }
    }

    private boolean isWanted(ConsumerRecord<byte[], byte[]> letter) {
        String reason = header(letter, DeadLetter.REASON);
        if (reason.isEmpty()) {
            left.merge(OTHER, 1L, Long::sum);
            return false;
        }
        if (!wish.reasons().isEmpty() && !wish.reasons().contains(reason)) {
            left.merge(reason, 1L, Long::sum);
            return false;
        }
        if (header(letter, DeadLetter.MESSAGE).contains("(truncated")) {
            left.merge(TRUNCATED, 1L, Long::sum);
            return false;
        }
        fed.merge(reason, 1L, Long::sum);
        return true;
    }

    private ProducerRecord<byte[], byte[]> original(ConsumerRecord<byte[], byte[]> letter) {
        ProducerRecord<byte[], byte[]> record =
                new ProducerRecord<>(wish.to(), null, letter.timestamp(), letter.key(), letter.value());
        for (Header header : letter.headers()) {
            if (!ADDED.contains(header.key())) {
                record.headers().add(header);
            }
        }
        return record;
    }

    private static String header(ConsumerRecord<byte[], byte[]> letter, String name) {
        Header header = letter.headers().lastHeader(name);
        return header == null || header.value() == null ? "" : new String(header.value(), StandardCharsets.UTF_8);
    }

    private KafkaConsumer<byte[], byte[]> consumer() {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty(ConsumerConfig.GROUP_ID_CONFIG, wish.group());
        settings.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        settings.setProperty(ConsumerConfig.AUTO_OFFSET_RESET_CONFIG, "earliest");
        settings.setProperty(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, "false");
        settings.setProperty(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, "false");
        return new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }

    private KafkaProducer<byte[], byte[]> producer() {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty(ProducerConfig.TRANSACTIONAL_ID_CONFIG, wish.group());
        settings.setProperty(ProducerConfig.MAX_REQUEST_SIZE_CONFIG, Integer.toString(16 * 1024 * 1024));
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }
}
