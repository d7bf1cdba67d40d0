package io.furrow.control.alarm;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.readiness.RestartingWorker;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Knows the types of devices' entities: as they report, on {@code service.devices.health}, else as they are wanted, on {@code
 * service.devices}. Every instance reads all of both.
 */
final class DeviceTypes implements RestartingWorker.Work, Function<String, String> {
    static final String NAME = "device-types";

    private static final Logger LOG = LoggerFactory.getLogger(DeviceTypes.class);
    private static final Duration POLL = Duration.ofMillis(500);

    private final Properties client;
    private volatile Types types;

    private record Types(Map<String, String> reported, Map<String, String> wanted) {
        void take(ConsumerRecord<String, byte[]> record) {
            Map<String, String> map = record.topic().equals(Topics.DEVICES) ? wanted : reported;
            String type = record.value() == null ? null : type(record);
            if (record.key() != null && type == null) {
                map.remove(record.key());
            } else if (record.key() != null) {
                map.put(record.key(), type);
            }
        }

        private static String type(ConsumerRecord<String, byte[]> record) {
            try {
                JsonNode json = NgsiJson.read(record.value());
                return json.path("type").textValue();
            } catch (UnreadableException e) { // then its type is unknown
                LOG.debug("{}-{}@{} is no JSON", record.topic(), record.partition(), record.offset(), e);
                return null;
            }
        }
    }

    DeviceTypes(Properties client) {
        this.client = client;
    }

    /** Null where it is not known. @param identity tenant, service path and id of the entity */
    @Override
    public String apply(String identity) {
        Types known = types;
        if (known == null) {
            return null;
        }
        String reported = known.reported().get(identity);
        return reported == null ? known.wanted().get(identity) : reported;
    }

    /** Whether all was read that was there at the start. */
    boolean isLoaded() {
        return types != null;
    }

    String detail() {
        Types known = types;
        return known == null
                ? "reads the types of devices"
                : "%d wanted and %d reported types"
                        .formatted(known.wanted().size(), known.reported().size());
    }

    @Override
    public void run(RestartingWorker follower) {
        try (KafkaConsumer<String, byte[]> consumer = new KafkaConsumer<>(
                TopicScan.withoutGroup(client), new StringDeserializer(), new ByteArrayDeserializer())) {
            List<TopicPartition> partitions = new ArrayList<>(TopicScan.partitions(consumer, Topics.DEVICES));
            partitions.addAll(TopicScan.partitions(consumer, Topics.DEVICES_HEALTH));
            consumer.assign(partitions);
            consumer.seekToBeginning(partitions);
            Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
            Types fresh = new Types(new ConcurrentHashMap<>(), new ConcurrentHashMap<>());
            while (!follower.isClosing()) {
                ConsumerRecords<String, byte[]> records = consumer.poll(POLL);
                records.forEach(fresh::take);
                if (!records.isEmpty()) {
                    follower.succeeded();
                }
                if (types != fresh
                        && ends.entrySet().stream()
                                .allMatch(end -> consumer.position(end.getKey()) >= end.getValue())) {
                    types = fresh;
                }
            }
        }
    }
}
