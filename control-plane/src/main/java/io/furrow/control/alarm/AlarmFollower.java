package io.furrow.control.alarm;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;

import org.apache.kafka.clients.consumer.CommitFailedException;
import org.apache.kafka.clients.consumer.ConsumerRebalanceListener;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.InterruptException;
import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.manager.StateJson;
import io.furrow.model.topic.Topics;

/**
 * Does something with each change of an alarm, as a consumer group: where that was not done to its end, whoever is in the
 * group does it again. Followers of one group share the work; changes that are compacted before anybody is there are missed.
 */
final class AlarmFollower implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(AlarmFollower.class);
    private static final Duration POLL = Duration.ofSeconds(1);
    private static final Duration LONGEST_ACTION = Duration.ofMinutes(10);
    /** What changed before is no news for a group that never read. */
    private static final Duration NEWS = Duration.ofMinutes(10);

    private final Properties settings;
    private final Action action;
    private final Thread thread;
    private volatile boolean closed;

    /** What is done. */
    interface Action {
        /**
         * Comes back once it is done or given up.
         *
         * @throws InterruptedException where the follower is closed; the change is taken again then
         */
        void take(Alarm alarm) throws InterruptedException;
    }

    private AlarmFollower(String group, Properties settings, Action action) {
        this.settings = settings;
        this.action = action;
        this.thread = new Thread(this::follow, group);
    }

    /** @param client settings of Kafka clients, {@code bootstrap.servers} among them */
    static AlarmFollower start(String group, Properties client, Action action) {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("group.id", group);
        settings.put("isolation.level", "read_committed");
        settings.put("enable.auto.commit", "false");
        settings.put("auto.offset.reset", "latest");
        settings.put("max.poll.records", "1");
        settings.put("max.poll.interval.ms", Long.toString(LONGEST_ACTION.toMillis()));
        AlarmFollower follower = new AlarmFollower(group, settings, action);
        follower.thread.start();
        return follower;
    }

    private void follow() {
        while (!closed) {
            try (KafkaConsumer<String, byte[]> consumer =
                    new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer())) {
                followUntilClosed(consumer);
            } catch (InterruptException | InterruptedException e) {
                LOG.debug("{} ends, as close() asks", thread.getName());
            } catch (RetriableException | CommitFailedException e) {
                LOG.warn("{} lost Kafka and goes on when that is back", thread.getName(), e);
            } catch (KafkaException e) {
                LOG.error("{} stops; start it again once the cause is removed", thread.getName(), e);
                return;
            }
        }
    }

    private void followUntilClosed(KafkaConsumer<String, byte[]> consumer) throws InterruptedException {
        try {
            consumer.subscribe(List.of(Topics.ALARMS), new BeginWithNews(consumer));
            while (!closed) {
                follow(consumer);
            }
        } finally {
            Thread.interrupted(); // or the consumer could not leave its group in peace
        }
    }

    private void follow(KafkaConsumer<String, byte[]> consumer) throws InterruptedException {
        for (ConsumerRecord<String, byte[]> record : consumer.poll(POLL)) {
            Alarm alarm = read(record);
            if (alarm != null) {
                action.take(alarm);
            }
            consumer.commitSync();
        }
    }

    /** The clients' own {@code by_duration} waits for half a minute on a partition that holds nothing so new. */
    private record BeginWithNews(KafkaConsumer<?, ?> consumer) implements ConsumerRebalanceListener {
        @Override
        public void onPartitionsAssigned(Collection<TopicPartition> partitions) {
            Map<TopicPartition, Long> since = new HashMap<>();
            consumer.committed(Set.copyOf(partitions)).forEach((partition, known) -> {
                if (known == null) {
                    since.put(partition, System.currentTimeMillis() - NEWS.toMillis());
                }
            });
            Map<TopicPartition, OffsetAndMetadata> begin = new HashMap<>();
            Map<TopicPartition, Long> ends = consumer.endOffsets(since.keySet());
            consumer.offsetsForTimes(since)
                    .forEach((partition, found) -> begin.put(
                            partition, new OffsetAndMetadata(found == null ? ends.get(partition) : found.offset())));
            begin.forEach(consumer::seek);
            consumer.commitSync(begin);
        }

        @Override
        public void onPartitionsRevoked(Collection<TopicPartition> partitions) {}
    }

    /** Null where it was taken away, or is none. */
    private static Alarm read(ConsumerRecord<String, byte[]> record) {
        try {
            return record.value() == null ? null : StateJson.read(record.value(), Alarm.class);
        } catch (UncheckedIOException e) {
            LOG.warn("{}-{}@{} is no alarm and passed over", record.topic(), record.partition(), record.offset(), e);
            return null;
        }
    }

    /** Leaves the group; what it was doing is done again by whoever comes after it. */
    @Override
    public void close() {
        closed = true;
        thread.interrupt();
        try {
            thread.join(LONGEST_ACTION.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
