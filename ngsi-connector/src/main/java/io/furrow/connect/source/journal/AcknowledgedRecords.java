package io.furrow.connect.source.journal;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.apache.kafka.clients.consumer.Consumer;
import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.AuthorizationException;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.utils.Utils;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalReader;
import io.furrow.connect.journal.JournalRecord;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.text.FailureText;

/**
 * Searches the topics for the records that Kafka acknowledged last. A broker without replicas that lost power may restart
 * without them, although the offset store has their offsets. Events are identified by id; separate dead letters are not checked.
 */
public final class AcknowledgedRecords implements TaskJournals.Verification {
    private static final Logger LOG = LoggerFactory.getLogger(AcknowledgedRecords.class);

    private static final int MAX_RECORDS = 100_000;
    private static final long BYTES_AT_ONCE = 8L * 1024 * 1024;
    private static final long MARGIN_MILLIS = Duration.ofMinutes(1).toMillis();
    private static final Duration TIMEOUT = Duration.ofSeconds(30);
    private static final Duration POLL = Duration.ofMillis(500);

    private final Map<String, Object> client;
    private final List<String> topics;

    /**
     * @param client settings of a Kafka client
     * @param topics that of events, and that of dead letters, which receives events that are too large
     */
    public AcknowledgedRecords(Map<String, Object> client, List<String> topics) {
        this.client = new HashMap<>(client);
        this.client.put(ConsumerConfig.KEY_DESERIALIZER_CLASS_CONFIG, ByteArrayDeserializer.class);
        this.client.put(ConsumerConfig.VALUE_DESERIALIZER_CLASS_CONFIG, ByteArrayDeserializer.class);
        this.client.put(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        this.client.put(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, false);
        this.client.put(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, false);
        this.topics = topics;
    }

    private record Event(long sequence, String topic, String key, String id, long received) {
        /** The partition that Kafka's default partitioner chooses. */
        TopicPartition partition(int partitions) {
            int hash = Utils.murmur2(key.getBytes(StandardCharsets.UTF_8));
            return new TopicPartition(topic, Utils.toPositive(hash) % partitions);
        }
    }

    @Override
    public long firstMissing(Journal journal, long committed) throws InterruptedException {
        List<Event> acknowledged = acknowledged(journal, committed);
        if (acknowledged.isEmpty()) {
            return committed;
        }
        try (Consumer<byte[], byte[]> consumer = new KafkaConsumer<>(client)) {
            Search search = new Search(consumer, acknowledged);
            return search.missing().map(Event::sequence).orElse(committed);
        } catch (AuthorizationException e) {
            LOG.warn(
                    "journal {}: cannot check whether Kafka still has the last acknowledged record: {}; allow the user of"
                            + " admin.override.* to read the topics {}",
                    journal.id(),
                    FailureText.of(e),
                    topics);
            return committed;
        } catch (KafkaException e) {
            LOG.warn("journal {}: cannot check whether Kafka still has the last acknowledged record", journal.id(), e);
            return acknowledged.get(0).sequence();
        }
    }

    /** The events that the journal still has, in order. */
    private List<Event> acknowledged(Journal journal, long committed) throws InterruptedException {
        List<Event> events = new ArrayList<>();
        try (JournalReader reader = journal.reader(Math.max(journal.begin(), committed - MAX_RECORDS))) {
            boolean isDone = false;
            while (!isDone) {
                List<JournalRecord> some = reader.read(MAX_RECORDS, BYTES_AT_ONCE, Duration.ZERO);
                isDone = some.isEmpty();
                for (JournalRecord record : some) {
                    isDone |= record.sequence() >= committed;
                    if (record.sequence() < committed) {
                        event(record).ifPresent(events::add);
                    }
                }
            }
        } catch (java.io.IOException e) {
            throw new java.io.UncheckedIOException("cannot close a file that was only read", e);
        }
        return events;
    }

    /** Empty for a record without id or key, or of a topic from an earlier configuration. */
    private Optional<Event> event(JournalRecord kept) {
        KafkaRecord record = JournalRecordCodec.read(kept.payload());
        String id = record.headers().get(HeaderNames.CE_ID);
        String received = record.headers().get(HeaderNames.TS_SOURCE);
        return id == null || received == null || record.key() == null || !topics.contains(record.topic())
                ? Optional.empty()
                : Optional.of(new Event(kept.sequence(), record.topic(), record.key(), id, Long.parseLong(received)));
    }

    /** One search of the topics, from their ends backwards. */
    private final class Search {
        private final Consumer<byte[], byte[]> consumer;
        private final List<Event> desired;
        private final Set<String> left = new HashSet<>();
        private final long oldest;
        private final Instant deadline = Instant.now().plus(TIMEOUT);
        /** Kafka may have deleted events that were received before these times. */
        private final Map<TopicPartition, Long> deletedBefore = new HashMap<>();

        Search(Consumer<byte[], byte[]> consumer, List<Event> desired) {
            this.consumer = consumer;
            this.desired = desired;
            desired.forEach(event -> left.add(event.id()));
            oldest = desired.stream().mapToLong(Event::received).min().orElseThrow();
        }

        Optional<Event> missing() {
            Set<String> existing = consumer.listTopics(TIMEOUT).keySet();
            List<TopicPartition> partitions = topics.stream()
                    .filter(existing::contains)
                    .flatMap(topic -> consumer.partitionsFor(topic, TIMEOUT).stream())
                    .map(info -> new TopicPartition(info.topic(), info.partition()))
                    .toList();
            Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions, TIMEOUT);
            Map<TopicPartition, Long> ends = consumer.endOffsets(partitions, TIMEOUT);
            partitions.forEach(partition -> look(partition, begins.get(partition), ends.get(partition)));
            return desired.stream()
                    .filter(event -> left.contains(event.id()))
                    .filter(event -> event.received() >= deletedBefore(event, partitions))
                    .findFirst();
        }

        private long deletedBefore(Event event, List<TopicPartition> partitions) {
            int count = (int) partitions.stream()
                    .filter(partition -> partition.topic().equals(event.topic()))
                    .count();
            return count == 0 ? Long.MIN_VALUE : deletedBefore.getOrDefault(event.partition(count), Long.MIN_VALUE);
        }

        private void look(TopicPartition partition, long begin, long end) {
            consumer.assign(List.of(partition));
            long step = 2L * desired.size() + 100;
            long to = end;
            while (to > begin && !left.isEmpty()) {
                long from = Math.max(begin, to - step);
                long received = read(partition, from, to);
                if (received < oldest - MARGIN_MILLIS) {
                    return;
                }
                if (from == begin && begin > 0 && received < Long.MAX_VALUE) {
                    deletedBefore.put(partition, received);
                }
                to = from;
                step *= 2;
            }
        }

        /** Returns the least time of receipt, the greatest number if no record has one. */
        private long read(TopicPartition partition, long from, long to) {
            long least = Long.MAX_VALUE;
            consumer.seek(partition, from);
            while (consumer.position(partition, TIMEOUT) < to) {
                if (Instant.now().isAfter(deadline)) {
                    throw new KafkaException("no answer within " + TIMEOUT.toSeconds() + " s");
                }
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    left.remove(text(record, HeaderNames.CE_ID));
                    String received = text(record, HeaderNames.TS_SOURCE);
                    if (received.matches("\\d{1,18}")) {
                        least = Math.min(least, Long.parseLong(received));
                    }
                }
            }
            return least;
        }
    }

    /** Whatever the worker's header converter wrote. */
    private static String text(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null || header.value() == null
                ? ""
                : new String(header.value(), StandardCharsets.UTF_8).replace("\"", "");
    }
}
