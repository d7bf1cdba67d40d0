package io.furrow.soak.year;

import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.soak.CommittedState;
import io.furrow.soak.year.Tap.Report;

/** Counts how often each report of a device is on a topic. */
final class ReportLog implements AutoCloseable {
    private static final String END_OF_REPLAY = "urn:ngsi-ld:Replay:";

    private final KafkaConsumer<String, byte[]> consumer;

    ReportLog(String kafka) {
        consumer = CommittedState.consumer(kafka);
    }

    Map<Report, Integer> all(String topic) throws UnreadableException {
        return all(List.of(topic)).get(topic);
    }

    /** The reports by topic. */
    Map<String, Map<Report, Integer>> all(List<String> topics) throws UnreadableException {
        Map<String, Map<Report, Integer>> reports = new HashMap<>();
        topics.forEach(topic -> reports.put(topic, new HashMap<>()));
        read(topics, new HashMap<>(), reports);
        return reports;
    }

    /** Reads new records. @param read offsets up to which each partition was read; updated */
    void readNew(String topic, Map<TopicPartition, Long> read, Map<Report, Integer> into) throws UnreadableException {
        read(List.of(topic), read, Map.of(topic, into));
    }

    private void read(List<String> topics, Map<TopicPartition, Long> read, Map<String, Map<Report, Integer>> into)
            throws UnreadableException {
        List<TopicPartition> partitions = CommittedState.partitions(consumer, topics);
        consumer.assign(partitions);
        Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions);
        partitions.forEach(each -> consumer.seek(each, Math.max(begins.get(each), read.getOrDefault(each, 0L))));
        Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            for (ConsumerRecord<String, byte[]> record : consumer.poll(Duration.ofMillis(100))) {
                Report report = record.value() == null
                        ? null
                        : Report.of(Entity.parse(record.value()).json());
                if (report != null
                        && report.time() > 0
                        && !report.entity().startsWith(END_OF_REPLAY)) { // a report of a device
                    into.get(record.topic()).merge(report, 1, Integer::sum);
                }
            }
        }
        partitions.forEach(each -> read.put(each, consumer.position(each)));
    }

    /** The number of records that retention has deleted from the beginning of a topic. */
    long removed(String topic) {
        return consumer.beginningOffsets(CommittedState.partitions(consumer, List.of(topic))).values().stream()
                .mapToLong(Long::longValue)
                .sum();
    }

    @Override
    public void close() {
        consumer.close();
    }
}
