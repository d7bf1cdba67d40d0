package io.furrow.control.alarm.action;

import java.nio.charset.StandardCharsets;
import java.time.Clock;
import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.clients.consumer.ConsumerRebalanceListener;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndTimestamp;
import org.apache.kafka.common.TopicPartition;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.alarm.watch.DeviceTypeCache;
import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Reads predictions from {@code data.collision} and passes them to {@link StopRobots} directly, without waiting for
 * alarms. Instances share the partitions as a consumer group. No offset is committed, because a prediction is useless
 * later: an instance that is assigned a partition starts at fresh records and reads the commands already sent from the
 * audit topic.
 */
final class PredictionConsumer implements SupervisedWorker.Work, ConsumerRebalanceListener {
    static final String NAME = "stop-on-predicted";

    private static final Logger LOG = LoggerFactory.getLogger(PredictionConsumer.class);
    private static final String GROUP = "furrow-stop-on-predicted";
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration TAKEN_OVER_AFTER = Duration.ofSeconds(10);
    private static final Duration AUDIT_LOOKBACK = Duration.ofHours(1);
    private static final String PREDICTED = "predicted";

    private final Properties client;
    private final StopRobots robots;
    private final DeviceTypeCache types;
    private final Clock clock;
    private KafkaConsumer<String, byte[]> consumer;

    PredictionConsumer(Properties client, StopRobots robots, DeviceTypeCache types, Clock clock) {
        this.client = client;
        this.robots = robots;
        this.types = types;
        this.clock = clock;
    }

    @Override
    public void run(SupervisedWorker worker) throws InterruptedException {
        while (!types.isLoaded()) {
            if (worker.isClosing()) {
                return;
            }
            TimeUnit.MILLISECONDS.sleep(POLL.toMillis());
        }
        try (KafkaConsumer<String, byte[]> subscribed = KafkaClients.consumer(settings())) {
            consumer = subscribed;
            consumer.subscribe(List.of(Topics.COLLISION), this);
            while (!worker.isClosing()) {
                consumer.poll(POLL).forEach(this::take);
            }
        } finally {
            Thread.interrupted(); // else the consumer could not leave its group cleanly
        }
    }

    private Properties settings() {
        Properties settings = CommittedReader.settings(client);
        settings.put("group.id", GROUP);
        settings.put("auto.offset.reset", "latest");
        // A transaction of the job may stay open until its next checkpoint; a prediction cannot wait for that and is
        // valid before.
        settings.put("isolation.level", "read_uncommitted");
        settings.put("session.timeout.ms", Long.toString(TAKEN_OVER_AFTER.toMillis()));
        return settings;
    }

    private void take(ConsumerRecord<String, byte[]> record) {
        // Few records of encounters are predictions; the others are not parsed.
        if (record.value() == null || !new String(record.value(), StandardCharsets.ISO_8859_1).contains(PREDICTED)) {
            return;
        }
        try {
            robots.take(EncounterReport.read(record.value(), KafkaClients.scope(record.headers())), record.timestamp());
        } catch (UnreadableException e) {
            LOG.warn("record {} is not an encounter and is skipped", KafkaClients.position(record), e);
        }
    }

    @Override
    public void onPartitionsAssigned(Collection<TopicPartition> partitions) {
        try (CommittedReader<String> audit = CommittedReader.open(client, Topics.AUDIT)) {
            audit.seekToTime(clock.millis() - AUDIT_LOOKBACK.toMillis()).readToEnd(this::restore);
        }
        Map<TopicPartition, Long> fresh = new HashMap<>();
        partitions.forEach(partition -> fresh.put(partition, clock.millis() - StopRobots.FRESH.toMillis()));
        Map<TopicPartition, OffsetAndTimestamp> found = consumer.offsetsForTimes(fresh);
        Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
        partitions.forEach(partition -> consumer.seek(
                partition,
                found.get(partition) == null
                        ? ends.get(partition)
                        : found.get(partition).offset()));
    }

    private void restore(ConsumerRecord<String, byte[]> entry) {
        try {
            if (entry.value() != null) {
                robots.restore(NgsiJson.read(entry.value()));
            }
        } catch (UnreadableException e) {
            LOG.debug("audit record {} is not JSON and is skipped", KafkaClients.position(entry), e);
        }
    }

    @Override
    public void onPartitionsRevoked(Collection<TopicPartition> partitions) {}
}
