package io.furrow.control.letter;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.regex.Pattern;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.config.TopicConfig;
import org.apache.kafka.common.errors.TimeoutException;
import org.apache.kafka.common.errors.TopicExistsException;

import io.furrow.kafka.CommittedReader;

/**
 * The offsets up to which the dead letters of each partition, reason and stage were redriven to a topic: the compacted topic
 * {@code <dead letters>.refed}, written in the same transaction. No letter is sent twice, whatever combination of reasons and stages
 * is requested; and unlike a consumer group's offsets these do not expire after a week. A letter that was left before a redriven one
 * is stored individually.
 */
final class RedriveOffsets {
    private static final String LEFT = "|left|";
    private static final Pattern IS_LEFT = Pattern.compile("\\|left\\|\\d+$");

    private final String topic;
    private final String prefix;
    private final Map<String, Long> next = new HashMap<>();
    private final Map<String, Long> changed = new HashMap<>();
    private final Set<String> left = new HashSet<>();

    /** @param dead id of the topic of dead letters, because offsets of a recreated topic begin at 0 again */
    private RedriveOffsets(String topic, String dead, String to) {
        this.topic = topic;
        this.prefix = dead + "|" + to + "|";
    }

    /**
     * @param making whether to create a missing topic; otherwise no offsets are stored then
     * @throws IOException if Kafka refuses; the message says why
     */
    static RedriveOffsets read(Properties kafka, Redrive.Request request, boolean making) throws IOException {
        String topic = request.from() + ".refed";
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty("request.timeout.ms", Long.toString(Redrive.TIMEOUT.toMillis()));
        settings.setProperty("default.api.timeout.ms", Long.toString(Redrive.TIMEOUT.toMillis()));
        try (Admin admin = Admin.create(settings)) {
            String dead = admin.describeTopics(List.of(request.from()))
                    .allTopicNames()
                    .get()
                    .get(request.from())
                    .topicId()
                    .toString();
            RedriveOffsets memory = new RedriveOffsets(topic, dead, request.target());
            if (making) {
                make(admin, topic);
            }
            if (making || admin.listTopics().names().get().contains(topic)) {
                memory.readAll(settings);
            }
            return memory;
        } catch (ExecutionException e) {
            throw new IOException("%s: %s".formatted(topic, e.getCause().getMessage()), e.getCause());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted", e);
        }
    }

    private static void make(Admin admin, String topic) throws ExecutionException, InterruptedException {
        NewTopic compacted = new NewTopic(topic, Optional.of(1), Optional.empty())
                .configs(Map.of(TopicConfig.CLEANUP_POLICY_CONFIG, TopicConfig.CLEANUP_POLICY_COMPACT));
        try {
            admin.createTopics(List.of(compacted)).all().get();
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException)) {
                throw e;
            }
        }
    }

    private void readAll(Properties settings) throws IOException {
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(settings, topic)) {
            reader.readToEnd(this::remember);
        } catch (TimeoutException e) {
            throw new IOException("the end of " + topic + " was not reached; does its broker respond?", e);
        }
    }

    private void remember(ConsumerRecord<byte[], byte[]> record) {
        String key = new String(record.key(), StandardCharsets.UTF_8);
        if (!key.startsWith(prefix)) {
            return;
        }
        if (record.value() == null) {
            left.remove(key);
        } else if (IS_LEFT.matcher(key).find()) {
            left.add(key);
        } else {
            next.put(key, Long.parseLong(new String(record.value(), StandardCharsets.UTF_8)));
        }
    }

    /** Whether the letter at this offset was redriven before. */
    boolean holds(int partition, Redrive.Kind kind, long offset) {
        return offset < next.getOrDefault(key(partition, kind), 0L) && !left.contains(leftKey(partition, kind, offset));
    }

    /** Adds an offset to the next {@link #changes()}. */
    void add(int partition, Redrive.Kind kind, long offset) {
        String key = key(partition, kind);
        if (offset >= next.getOrDefault(key, 0L)) { // a letter that is redriven again is stored already
            next.put(key, offset + 1);
            changed.put(key, offset + 1);
        }
        String leftKey = leftKey(partition, kind, offset);
        if (left.remove(leftKey)) {
            changed.put(leftKey, null);
        }
    }

    /** The same for a letter that cannot be redriven. */
    void leave(int partition, Redrive.Kind kind, long offset) {
        String key = leftKey(partition, kind, offset);
        if (offset >= next.getOrDefault(key(partition, kind), 0L) && left.add(key)) {
            changed.put(key, offset);
        }
    }

    /** The changes since the last call, for the transaction that sends these letters. */
    List<ProducerRecord<byte[], byte[]>> changes() {
        List<ProducerRecord<byte[], byte[]>> records = new ArrayList<>();
        changed.forEach((key, offset) -> records.add(new ProducerRecord<>(
                topic,
                0,
                key.getBytes(StandardCharsets.UTF_8),
                offset == null ? null : offset.toString().getBytes(StandardCharsets.UTF_8))));
        changed.clear();
        return records;
    }

    private String leftKey(int partition, Redrive.Kind kind, long offset) {
        return key(partition, kind) + LEFT + offset;
    }

    private String key(int partition, Redrive.Kind kind) {
        return prefix + partition + "|" + kind.reason() + "|" + kind.stage();
    }
}
