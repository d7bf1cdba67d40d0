package io.furrow.control.letter;

import java.io.IOException;
import java.time.Duration;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/**
 * Sends dead letters to a topic again, unchanged: key, bytes, time and headers, without those that explain the failure; a letter that
 * refers to a large record is replaced by that record. The records and the offsets redriven are one transaction, so that no letter is sent
 * twice. Reads up to the end offsets at the start, for at most {@link #MAX_TIME}: a letter that fails again waits for the next run.
 */
public final class Redrive {
    /**
     * Stages whose letters are copies: the event continued without its image or its mission, to its topics though not to MongoDB, or to the
     * other jobs. A redrive would duplicate it, so these letters must be requested by name.
     */
    public static final Set<String> WENT_ON = Stream.concat(
                    Stream.of("routes", "ingest-images", "missions"), AnalyticsKind.jobNames().stream())
            .collect(Collectors.toUnmodifiableSet());

    /** The stage of the NGSI source. */
    private static final String NGSI_SOURCE = "ngsi-source";

    static final Duration TIMEOUT = Duration.ofSeconds(10);
    /** A client waits for the answer. */
    private static final Duration MAX_TIME = Duration.ofSeconds(15);
    /** For a transaction with large originals. A broker's default limit is 15 minutes. */
    private static final Duration TRANSACTION_TIMEOUT = Duration.ofMinutes(10);

    private static final String OTHER = "without the header dead-reason, for instance of Kafka Connect";
    private static final String TRUNCATED = "truncated";
    private static final String GONE = "original gone";
    private static final String NOTIFICATION =
            "from notifications to the NGSI source, not from a topic; where the normalize job runs, 'to' can be its topic, "
                    + Topics.NOTIFICATIONS;

    /**
     * A request to redrive.
     *
     * @param from topic of the dead letters
     * @param to target topic; null for the topic to which the letters belong, without those that come from no topic
     * @param again whether letters that were redriven before are sent again
     * @param dryRun whether letters are only counted
     */
    public record Request(String from, String to, Choice choice, boolean again, boolean dryRun) {
        /** The topic that receives the letters. */
        public String target() {
            return to == null ? Topics.ofDeadLetters(from).orElseThrow() : to;
        }
    }

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

    /**
     * The number of redriven letters by reason, and of the others by why they were left.
     *
     * @param isComplete false if the time ended before the last letter
     */
    public record Outcome(Map<String, Long> sent, Map<String, Long> left, boolean isComplete) {
        public long total() {
            return sent.values().stream().mapToLong(Long::longValue).sum();
        }
    }

    private final Properties kafka;
    private final Request request;
    private final Map<String, Long> sent = new TreeMap<>();
    private final Map<String, Long> left = new TreeMap<>();
    private RedriveOffsets memory;
    private OriginalReader originals;

    /** @param kafka common settings of clients, at least {@code bootstrap.servers} */
    public Redrive(Properties kafka, Request request) {
        this.kafka = kafka;
        this.request = request;
    }

    /**
     * @throws UnknownTopicOrPartitionException if one of the topics does not exist
     * @throws IOException if a topic cannot be read
     */
    public Outcome run() throws IOException {
        try (var consumer = consumer();
                var found = new OriginalReader(consumer());
                var producer = request.dryRun() ? null : producer()) {
            originals = found;
            assign(consumer);
            Map<TopicPartition, Long> ends = consumer.endOffsets(consumer.assignment(), TIMEOUT);
            if (producer != null) {
                producer.initTransactions(); // fences another redrive of the same, whose writes are visible then
            }
            memory = RedriveOffsets.read(kafka, request, producer != null);
            long until = System.nanoTime() + MAX_TIME.toNanos();
            boolean isBehind = isBehind(consumer, ends);
            while (isBehind && System.nanoTime() < until) {
                send(consumer.poll(Duration.ofMillis(200)), ends, producer);
                isBehind = isBehind(consumer, ends);
            }
            return new Outcome(sent, left, !isBehind);
        }
    }

    private void assign(KafkaConsumer<byte[], byte[]> consumer) {
        consumer.assign(RecordReader.partitions(
                consumer, request.from(), "'./furrow dead-letters list' shows those that have letters"));
        RecordReader.partitions(consumer, request.target(), "name another as 'to', which gets the letters");
        consumer.seekToBeginning(consumer.assignment());
    }

    private static boolean isBehind(KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> ends) {
        return ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue());
    }

    /** Originals may be large: each is sent before the next is read. */
    private void send(
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
                sent.merge(kind(deadLetter).reason(), 1L, Long::sum);
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
        if (request.to() == null
                && isNotification(deadLetter)
                && request.choice().isOf(kind)) {
            left.merge(NOTIFICATION, 1L, Long::sum);
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

    /** Whether it is from a request to the NGSI source: a record that was too large for a topic names the topic. */
    private boolean isNotification(ConsumerRecord<byte[], byte[]> deadLetter) {
        return header(deadLetter, DeadLetter.STAGE).equals(NGSI_SOURCE)
                && !header(deadLetter, DeadLetter.SOURCE).equals(request.target());
    }

    private static Kind kind(ConsumerRecord<byte[], byte[]> deadLetter) {
        return new Kind(header(deadLetter, DeadLetter.REASON), header(deadLetter, DeadLetter.STAGE));
    }

    private ProducerRecord<byte[], byte[]> broughtBack(ConsumerRecord<byte[], byte[]> original) {
        ProducerRecord<byte[], byte[]> record = new ProducerRecord<>(
                request.target(), null, OriginalReader.timeOf(original), original.key(), original.value());
        for (Header header : original.headers()) {
            if (!DeadLetter.HEADERS.contains(header.key())) {
                record.headers().add(header);
            }
        }
        return record;
    }

    private static String header(ConsumerRecord<byte[], byte[]> deadLetter, String name) {
        return Objects.requireNonNullElse(KafkaClients.text(deadLetter.headers(), name), "");
    }

    private KafkaConsumer<byte[], byte[]> consumer() {
        return RecordReader.consumer(kafka);
    }

    private KafkaProducer<byte[], byte[]> producer() {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty(
                ProducerConfig.TRANSACTIONAL_ID_CONFIG, "furrow-redrive-" + request.from() + "-" + request.target());
        settings.setProperty(ProducerConfig.TRANSACTION_TIMEOUT_CONFIG, Long.toString(TRANSACTION_TIMEOUT.toMillis()));
        settings.setProperty(ProducerConfig.MAX_BLOCK_MS_CONFIG, Long.toString(TIMEOUT.toMillis()));
        // The topic may have just been created, see KAFKA-15591.
        settings.setProperty(ProducerConfig.MAX_IN_FLIGHT_REQUESTS_PER_CONNECTION, "1");
        settings.setProperty(ProducerConfig.MAX_REQUEST_SIZE_CONFIG, Integer.toString(16 * 1024 * 1024));
        return new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }
}
