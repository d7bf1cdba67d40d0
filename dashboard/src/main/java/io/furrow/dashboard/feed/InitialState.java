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
 * What was known of the keys of a topic before a stream began. Of {@code data.raw} and the topics of domains and missions it is what
 * {@code data.latest} has of their entities, of a replay the newest of each entity in its newest epoch, of any other topic the
 * newest of each key; where the topic is not compacted, of the last hour.
 *
 * @param compacted whether a topic is
 */
public record InitialState(Properties client, StreamLimits limits, Predicate<String> compacted) {
    private static final Pattern LIVE = Pattern.compile("data\\.[^.]+\\.realtime(\\.[^.]+)?");
    private static final Duration TIMEOUT = Duration.ofSeconds(30);
    /** What is older is history, not state: such a topic may hold a week of records each second. */
    private static final Duration NOT_COMPACTED = Duration.ofHours(1);

    private static final String EPOCH = "replay-epoch";
    private static final String KIND = "replay-kind";

    /** @throws Problem where it takes too long, or is too much */
    public List<FeedRecord> read(String topic) {
        boolean live = topic.equals(Topics.RAW) || LIVE.matcher(topic).matches();
        Predicate<ConsumerRecord<byte[], byte[]>> desired = live ? record -> isOf(topic, record) : record -> true;
        Map<String, FeedRecord> newest = new LinkedHashMap<>();
        long[] epoch = {-1};
        String source = live ? Topics.LATEST : topic;
        long begun = System.nanoTime();
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(settings(), source)) {
            // a replay's records bear times of then
            if (!live && !Topics.isOfReplay(source) && !compacted.test(source)) {
                reader.seekToTime(System.currentTimeMillis() - NOT_COMPACTED.toMillis());
            }
            reader.readToEnd(record -> {
                if (reader.isBeforeEnd(record) && isOfNewestEpoch(record, epoch, newest)) {
                    put(record, newest, desired);
                }
                check(source, newest, begun);
            });
        } catch (TimeoutException e) {
            throw tooSlow(source);
        }
        return new ArrayList<>(newest.values());
    }

    /** Each epoch of a replay says again what is known, and ends with a record that reports no entity. */
    private static boolean isOfNewestEpoch(
            ConsumerRecord<byte[], byte[]> record, long[] epoch, Map<String, FeedRecord> newest) {
        String text = KafkaClients.text(record.headers(), EPOCH);
        if (text == null) {
            return true;
        }
        long of = Long.parseLong(text);
        if (of > epoch[0]) {
            epoch[0] = of;
            newest.clear();
        }
        return of == epoch[0] && !"end".equals(KafkaClients.text(record.headers(), KIND));
    }

    private void put(
            ConsumerRecord<byte[], byte[]> record,
            Map<String, FeedRecord> newest,
            Predicate<ConsumerRecord<byte[], byte[]>> desired) {
        FeedRecord next = new FeedRecord(record, FeedRecord.NO_SEQUENCE, limits.valueBytes());
        newest.remove(next.key());
        if (record.value() == null) {
            newest.values().removeIf(next::deletes);
        } else if (desired.test(record)) {
            newest.put(next.key(), next);
        }
    }

    private void check(String source, Map<String, FeedRecord> newest, long begun) {
        if (newest.size() > limits.primeRecords()) {
            throw new Problem(
                    503, "too-much", "topic '%s' has more than %d keys".formatted(source, limits.primeRecords()));
        }
        if (System.nanoTime() - begun > TIMEOUT.toNanos()) {
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
