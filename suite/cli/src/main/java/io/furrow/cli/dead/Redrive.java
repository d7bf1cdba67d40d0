package io.furrow.cli.dead;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.result.AnalyticsKind;

/**
 * Sends dead letters to a topic again, unchanged: key, bytes, time and headers, without those that explain the failure; a letter that
 * refers to a large record is replaced by that record. The records and the offsets redriven are one transaction, so that no letter is sent
 * twice. Reads up to the end offsets at the start: a letter that fails again waits for the next run.
 */
public final class Redrive {
    /**
     * Stages whose letters are copies: the event continued without its image or its mission, to its topics though not to MongoDB, or to the
     * other jobs. A redrive would duplicate it, so these letters must be requested by name.
     */
    public static final Set<String> WENT_ON = Stream.concat(
                    Stream.of("routes", "ingest-images", "missions"), AnalyticsKind.jobNames().stream())
            .collect(Collectors.toUnmodifiableSet());

    static final Duration TIMEOUT = Duration.ofSeconds(30);
    /** For a transaction with large originals. A broker's default limit is 15 minutes. */
    private static final Duration TRANSACTION_TIMEOUT = Duration.ofMinutes(10);

    private static final String OTHER = "no dead letter";
    private static final String TRUNCATED = "truncated";
    private static final String GONE = "original gone";

    /**
     * A request to redrive.
     *
     * @param from topic of the dead letters
     * @param to target topic
     * @param again whether letters that were redriven before are sent again
     * @param dryRun whether letters are only counted
     */
    public record Request(String from, String to, Choice choice, boolean again, boolean dryRun) {}

    /**
     * The selection of letters.
     *
     * @param reasons selected ones; empty for all
     * @param stages selected ones; empty for all but {@link #WENT_ON}
     */
    public record Choice(Set<String> reasons, Set<String> stages) {
        boolean isOf(Kind kind) {
            boolean desired = stages.isEmpty() ? !WENT_ON.contains(kind.stage()) : stages.contains(kind.stage());
            return desired && (reasons.isEmpty() || reasons.contains(kind.reason()));
        }
    }

    /** The reason and stage of a letter. */
    record Kind(String reason, String stage) {
        /** For display. */
        String description() {
            return WENT_ON.contains(stage)
                    ? reason + " of " + stage + ", whose event went on"
                    : reason + " of " + stage;
        }
    }

    /** The number of redriven letters by reason, and of the others by why they were left. */
    public record Outcome(Map<String, Long> fed, Map<String, Long> left) {
        public long total() {
            return fed.values().stream().mapToLong(Long::longValue).sum();
        }
    }

    private final Properties kafka;
    private final Request request;
    private final Map<String, Long> fed = new TreeMap<>();
    private final Map<String, Long> left = new TreeMap<>();
    private RedriveOffsets memory;
    private OriginalReader originals;

    /** @param kafka common settings of clients, at least {@code bootstrap.servers} */
    public Redrive(Properties kafka, Request request) {
        this.kafka = kafka;
        this.request = request;
    }

    /** @throws IOException if the topic does not exist, or its end is not reached */
    public Outcome run() throws IOException {
        try (var consumer = consumer();
                var found = new OriginalReader(consumer());
                var producer = request.dryRun() ? null : producer()) {
            originals = found;
            assign(consumer);
            Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment(), TIMEOUT);
            if (producer != null) {
                producer.initTransactions(); // fences another redrive of the same, whose writes are
                // visible then
            }
            memory = RedriveOffsets.read(kafka, request, producer != null);
            long until = System.nanoTime() + TIMEOUT.toNanos();
            while (isBehind(consumer, ends)) {
                ConsumerRecords<byte[], byte[]> records = consumer.poll(Duration.ofMillis(200));
                if (!records.isEmpty()) {
                    feed(records, ends, producer);
                    until = System.nanoTime() + TIMEOUT.toNanos();
                } else if (System.nanoTime() > until) {
                    throw new IOException("the end of " + request.from() + " was not reached; does its broker answer?");
                }
            }
            return new Outcome(fed, left);
        }
    }

    private void assign(KafkaConsumer<byte[], byte[]> consumer) throws IOException {
        List<PartitionInfo> partitions = consumer.partitionsFor(request.from(), TIMEOUT);
        if (partitions == null || partitions.isEmpty()) {
            throw new IOException("there is no topic " + request.from() + "; name another with --topic");
        }
        consumer.assign(partitions.stream()
                .map(partition -> new TopicPartition(request.from(), partition.partition()))
                .toList());
        consumer.seekToBeginning(consumer.assignment());
    }

    private static boolean isBehind(KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> ends) {
        return ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue());
    }

    /** Originals may be large: each is sent before the next is read. */
    private void feed(
            ConsumerRecords<byte[], byte[]> records,
            Map<TopicPartition, Long> ends,
            KafkaProducer<byte[], byte[]> producer)
            throws IOException {
        boolean begun = false;
        for (ConsumerRecord<byte[], byte[]> deadLetter : records) {
            boolean isNew =
                    deadLetter.offset() >= ends.get(new TopicPartition(deadLetter.topic(), deadLetter.partition()));
            boolean isDesired = !isNew && isDesired(deadLetter);
            Optional<ConsumerRecord<byte[], byte[]>> original = isDesired ? original(deadLetter) : Optional.empty();
            if (isDesired && original.isEmpty()) {
                memory.leave(deadLetter.partition(), kind(deadLetter), deadLetter.offset());
            } else if (original.isPresent()) {
                memory.add(deadLetter.partition(), kind(deadLetter), deadLetter.offset());
                fed.merge(kind(deadLetter).reason(), 1L, Long::sum);
                if (producer != null) {
                    if (!begun) {
                        producer.beginTransaction();
                        begun = true;
                    }
                    producer.send(broughtBack(original.get()));
                }
            }
        }
        if (begun) {
            memory.changes().forEach(producer::send);
            producer.commitTransaction();
        }
    }

    private boolean isDesired(ConsumerRecord<byte[], byte[]> deadLetter) {
        Kind kind = kind(deadLetter);
        if (kind.reason().isEmpty()) {
            left.merge(OTHER, 1L, Long::sum);
            return false;
        }
        if (!request.again() && memory.holds(deadLetter.partition(), kind, deadLetter.offset())) {
            return false;
        }
        if (!request.choice().isOf(kind)) {
            left.merge(kind.description(), 1L, Long::sum);
            return false;
        }
        return true;
    }

    /** The letter itself, or the record that it refers to; empty, and counted as left, if neither is complete. */
    private Optional<ConsumerRecord<byte[], byte[]>> original(ConsumerRecord<byte[], byte[]> deadLetter)
            throws IOException {
        Optional<OriginalReference> elsewhere = OriginalReference.of(
                header(deadLetter, OriginalReference.POSITION), header(deadLetter, OriginalReference.BYTES));
        if (elsewhere.isPresent()) {
            Optional<ConsumerRecord<byte[], byte[]>> found = originals.find(elsewhere.get(), deadLetter);
            if (found.isEmpty()) {
                left.merge(GONE, 1L, Long::sum);
            }
            return found;
        }
        if (header(deadLetter, DeadLetter.MESSAGE).contains("(truncated")) {
            left.merge(TRUNCATED, 1L, Long::sum);
            return Optional.empty();
        }
        return Optional.of(deadLetter);
    }

    private static Kind kind(ConsumerRecord<byte[], byte[]> deadLetter) {
        return new Kind(header(deadLetter, DeadLetter.REASON), header(deadLetter, DeadLetter.STAGE));
    }

    private ProducerRecord<byte[], byte[]> broughtBack(ConsumerRecord<byte[], byte[]> original) {
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(
                request.to(), null, OriginalReader.timeOf(original), original.key(), original.value());
        for (Header header : original.headers()) {
            if (!DeadLetter.HEADERS.contains(header.key())) {
                record.headers().add(header);
            }
        }
        return record;
    }

    private static String header(ConsumerRecord<byte[], byte[]> deadLetter, String name) {
        Header header = deadLetter.headers().lastHeader(name);
        return header == null || header.value() == null ? "" : new String(header.value(), StandardCharsets.UTF_8);
    }

    private KafkaConsumer<byte[], byte[]> consumer() {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        settings.setProperty(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, "false");
        return new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }

    private KafkaProducer<byte[], byte[]> producer() {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty(
                ProducerConfig.TRANSACTIONAL_ID_CONFIG, "furrow-redrive-" + request.from() + "-" + request.to());
        settings.setProperty(ProducerConfig.TRANSACTION_TIMEOUT_CONFIG, Long.toString(TRANSACTION_TIMEOUT.toMillis()));
        // The topic may have just been created, see KAFKA-15591.
        settings.setProperty(ProducerConfig.MAX_IN_FLIGHT_REQUESTS_PER_CONNECTION, "1");
        settings.setProperty(ProducerConfig.MAX_REQUEST_SIZE_CONFIG, Integer.toString(16 * 1024 * 1024));
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }
}
