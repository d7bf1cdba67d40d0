package io.furrow.replay.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.consumer.CloseOptions;
import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.JobOptions;
import io.furrow.flink.KafkaTopicAtStart;
import io.furrow.flink.TopicAtStart;
import io.furrow.flink.TopicRecord;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** What {@code service.replays} says, and {@code service.replays.status} of the time before. A topic that is not there is awaited. */
public final class ReplaysTopic implements WantedReplays {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(ReplaysTopic.class);
    private static final Duration POLL = Duration.ofMillis(500);

    private final Properties client;
    private final TopicAtStart statuses;

    public ReplaysTopic(JobOptions options) {
        client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        client.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        client.setProperty(ConsumerConfig.AUTO_OFFSET_RESET_CONFIG, "earliest");
        client.setProperty(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, "false");
        client.setProperty(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, "false");
        client.remove(ConsumerConfig.GROUP_ID_CONFIG);
        statuses = new KafkaTopicAtStart(options, Topics.REPLAYS_STATUS);
    }

    @Override
    public boolean isBounded() {
        return false;
    }

    @Override
    public Reading open() {
        return new FromKafka(
                new KafkaConsumer<>(client, new ByteArrayDeserializer(), new ByteArrayDeserializer()), statuses);
    }

    private static String text(byte[] key) {
        return key == null ? null : new String(key, StandardCharsets.UTF_8);
    }

    private static final class FromKafka implements Reading {
        private final KafkaConsumer<byte[], byte[]> consumer;
        private final TopicAtStart statuses;
        private Map<TopicPartition, Long> ends;
        private volatile boolean closed;

        FromKafka(KafkaConsumer<byte[], byte[]> consumer, TopicAtStart statuses) {
            this.consumer = consumer;
            this.statuses = statuses;
        }

        @Override
        public List<Told> told() throws IOException {
            List<Told> told = new ArrayList<>();
            for (TopicRecord record : statuses.read()) {
                try {
                    if (record.key() != null && record.value() != null) {
                        told.add(new Told(text(record.key()), ReplayStatus.read(record.value())));
                    }
                } catch (UnreadableException e) {
                    LOG.warn("The status {} is passed over", record.position(), e);
                }
            }
            return told;
        }

        @Override
        public synchronized List<Wish> poll() {
            List<Wish> wishes = new ArrayList<>();
            try {
                if (!closed && (ends != null || isThere())) {
                    for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                        wishes.add(new Wish(text(record.key()), record.value()));
                    }
                }
            } catch (WakeupException e) { // it is being closed
                return List.of();
            }
            return wishes;
        }

        private boolean isThere() {
            List<PartitionInfo> partitions = consumer.partitionsFor(Topics.REPLAYS);
            if (partitions == null || partitions.isEmpty()) {
                LockSupport.parkNanos(POLL.toNanos());
                return false;
            }
            consumer.assign(partitions.stream()
                    .map(partition -> new TopicPartition(partition.topic(), partition.partition()))
                    .toList());
            consumer.seekToBeginning(consumer.assignment());
            ends = consumer.endOffsets(consumer.assignment());
            return true;
        }

        @Override
        public synchronized boolean isCaughtUp() {
            return !closed
                    && ends != null
                    && ends.entrySet().stream().allMatch(end -> consumer.position(end.getKey()) >= end.getValue());
        }

        @Override
        public void close() {
            closed = true;
            consumer.wakeup();
            synchronized (this) {
                consumer.close(CloseOptions.timeout(Duration.ofSeconds(1)));
            }
        }
    }
}
