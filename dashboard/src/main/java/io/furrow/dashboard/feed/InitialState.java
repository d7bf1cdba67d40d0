package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.function.Predicate;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.errors.TimeoutException;

import io.furrow.dashboard.http.Problem;
import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Reads the state of a topic's keys before a stream begins. For {@code data.raw} and the topics of domains and missions
 * this is the state of their entities on {@code data.latest}; for a replay, the newest record of each entity in its
 * newest epoch; for any other topic, the newest record of each key, if the topic is not compacted within the last hour.
 *
 * @param compacted whether a topic is compacted
 */
public record InitialState(Properties client, StreamLimits limits, StateBudget budget, Predicate<String> compacted) {
    private static final Pattern LIVE = Pattern.compile("data\\.[^.]+\\.realtime(\\.[^.]+)?");
    private static final Duration TIMEOUT = Duration.ofSeconds(30);
    /** Older records are history, not state: such a topic may hold a week of records per second. */
    private static final Duration NOT_COMPACTED = Duration.ofHours(1);

    /** Every stream that begins holds its initial state until the client has read it. */
    static final long MAX_BYTES = 64L * 1024 * 1024;

    private static final String EPOCH = "replay-epoch";
    private static final String KIND = "replay-kind";

    /** The records of a topic's keys, and their share of the memory; whoever gets them releases it. */
    public record State(List<FeedRecord> records, StateBudget.Share share) {}

    /** @throws Problem if reading takes too long, or there are too many keys or bytes */
    public State read(String topic) {
        StateBudget.Share share = budget.share();
        try {
            List<FeedRecord> records = read(topic, share);
            share.hold(1);
            return new State(records, share);
        } finally {
            share.release();
        }
    }

    private List<FeedRecord> read(String topic, StateBudget.Share share) {
        boolean live = topic.equals(Topics.RAW) || LIVE.matcher(topic).matches();
        Predicate<ConsumerRecord<byte[], byte[]>> filter = live ? record -> isOf(topic, record) : record -> true;
        Newest newest = new Newest(share);
        long[] epoch = {-1};
        String source = live ? Topics.LATEST : topic;
        long startedAt = System.nanoTime();
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(settings(), source)) {
            // records of a replay have past timestamps
            if (!live && !Topics.isOfReplay(source) && !compacted.test(source)) {
                reader.seekToTime(System.currentTimeMillis() - NOT_COMPACTED.toMillis());
            }
            reader.readToEnd(record -> {
                if (reader.isBeforeEnd(record) && isOfNewestEpoch(record, epoch, newest)) {
                    put(record, newest, filter);
                }
                check(source, newest, startedAt);
            });
        } catch (TimeoutException e) {
            throw tooSlow(source);
        }
        return new ArrayList<>(newest.byKey.values());
    }

    /** The newest record of each key, and their memory. */
    static final class Newest {
        private final StateBudget.Share share;
        private final Map<String, FeedRecord> byKey = new LinkedHashMap<>();
        private long bytes;

        Newest(StateBudget.Share share) {
            this.share = share;
        }

        void put(FeedRecord record) {
            remove(record);
            byKey.put(record.key(), record);
            bytes += record.bytes();
        }

        void remove(FeedRecord record) {
            FeedRecord older = byKey.remove(record.key());
            bytes -= older == null ? 0 : older.bytes();
        }

        /** @param deletion its key need not have a type */
        void delete(FeedRecord deletion) {
            byKey.values().removeIf(each -> {
                boolean deleted = deletion.deletes(each);
                bytes -= deleted ? each.bytes() : 0;
                return deleted;
            });
        }

        void clear() {
            byKey.clear();
            bytes = 0;
        }

        /** @throws Problem if a client must not read that much */
        void check(String source, int maxRecords) {
            if (byKey.size() > maxRecords) {
                throw new Problem(503, "too-much", "topic '%s' has more than %d keys".formatted(source, maxRecords));
            }
            if (bytes > MAX_BYTES) {
                throw new Problem(
                        503,
                        "too-much",
                        "the state of topic '%s' has more than %d MiB".formatted(source, MAX_BYTES / 1024 / 1024));
            }
            share.resize(bytes, source);
        }
    }

    /** Each epoch of a replay repeats the state of its entities, and ends with a record without an entity. */
    private static boolean isOfNewestEpoch(ConsumerRecord<byte[], byte[]> record, long[] epoch, Newest newest) {
        String text = KafkaClients.text(record.headers(), EPOCH);
        if (text == null) {
            return true;
        }
        long recordEpoch = Long.parseLong(text);
        if (recordEpoch > epoch[0]) {
            epoch[0] = recordEpoch;
            newest.clear();
        }
        return recordEpoch == epoch[0] && !"end".equals(KafkaClients.text(record.headers(), KIND));
    }

    private void put(
            ConsumerRecord<byte[], byte[]> record, Newest newest, Predicate<ConsumerRecord<byte[], byte[]>> filter) {
        FeedRecord next = new FeedRecord(record, FeedRecord.NO_SEQUENCE, limits.valueBytes());
        newest.remove(next);
        if (record.value() == null) {
            newest.delete(next);
        } else if (filter.test(record)) {
            record.headers()
                    .forEach(
                            header -> { // until they are read they keep Kafka's whole response in memory
                                header.key();
                                header.value();
                            });
            newest.put(next);
        }
    }

    private void check(String source, Newest newest, long startedAt) {
        newest.check(source, limits.primeRecords());
        if (System.nanoTime() - startedAt > TIMEOUT.toNanos()) {
            throw tooSlow(source);
        }
    }

    private static Problem tooSlow(String source) {
        return new Problem(503, "too-slow", "topic '%s' could not be read within 30 s".formatted(source));
    }

    private Properties settings() {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.setProperty("default.api.timeout.ms", Long.toString(TIMEOUT.toMillis()));
        return settings;
    }

    private static boolean isOf(String topic, ConsumerRecord<byte[], byte[]> record) {
        if (topic.equals(Topics.RAW)) {
            return true;
        }
        try {
            JsonNode entity = NgsiJson.read(record.value());
            String domain = entity.at("/Domain/value").asText();
            String mission = entity.at("/Mission/value").asText();
            return !domain.isEmpty()
                    && (topic.equals(Topics.realtime(domain))
                            || !mission.isEmpty() && topic.equals(Topics.realtime(domain, mission)));
        } catch (UnreadableException e) {
            return false;
        }
    }
}
