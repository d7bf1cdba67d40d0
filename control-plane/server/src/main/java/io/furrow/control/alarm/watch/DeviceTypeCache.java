package io.furrow.control.alarm.watch;

import java.time.Duration;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Looks up the entity types of devices: the reported type from {@code service.devices.health}, else the desired type
 * from {@code service.devices}. Every instance reads all partitions of both topics.
 */
public final class DeviceTypeCache implements SupervisedWorker.Work, Function<String, String> {
    public static final String NAME = "device-types";

    private static final Logger LOG = LoggerFactory.getLogger(DeviceTypeCache.class);
    private static final Duration POLL = Duration.ofMillis(500);

    private final Properties client;
    private volatile Types types;

    private record Types(Map<String, String> reported, Map<String, String> desired) {
        void take(ConsumerRecord<String, byte[]> record) {
            Map<String, String> map = record.topic().equals(Topics.DEVICES) ? desired : reported;
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
            } catch (UnreadableException e) { // the type stays unknown
                LOG.debug("record {} is not JSON and is skipped", KafkaClients.position(record), e);
                return null;
            }
        }
    }

    public DeviceTypeCache(Properties client) {
        this.client = client;
    }

    /**
     * Returns the type; null if unknown.
     *
     * @param identity tenant, service path and id of the entity
     */
    @Override
    public String apply(String identity) {
        Types existing = types;
        if (existing == null) {
            return null;
        }
        String reported = existing.reported().get(identity);
        return reported == null ? existing.desired().get(identity) : reported;
    }

    /** Whether all records that existed at the start were read. */
    public boolean isLoaded() {
        return types != null;
    }

    public String detail() {
        Types existing = types;
        return existing == null
                ? "reads the types of devices"
                : "%d desired and %d reported types"
                        .formatted(
                                existing.desired().size(), existing.reported().size());
    }

    @Override
    public void run(SupervisedWorker worker) {
        try (CommittedReader<String> reader = CommittedReader.open(client, Topics.DEVICES, Topics.DEVICES_HEALTH)) {
            Types fresh = new Types(new ConcurrentHashMap<>(), new ConcurrentHashMap<>());
            while (!worker.isClosing()) {
                ConsumerRecords<String, byte[]> records = reader.poll(POLL);
                records.forEach(fresh::take);
                if (!records.isEmpty()) {
                    worker.succeeded();
                }
                if (types != fresh && reader.isCaughtUp()) {
                    types = fresh;
                }
            }
        }
    }
}
