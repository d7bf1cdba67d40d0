package io.furrow.simulators.host;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Objects;
import java.util.Properties;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentLinkedQueue;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** What is said on {@code service.devices.status}: a record where a device's status is another than the last, and never less. */
final class StatusRecords implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StatusRecords.class);

    private static final Duration PATIENCE = Duration.ofSeconds(5);

    private final KafkaProducer<String, byte[]> producer;
    private final Map<String, DeviceStatus> said = new HashMap<>();
    private final Queue<String> lost = new ConcurrentLinkedQueue<>();

    StatusRecords(Properties kafka) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.putIfAbsent(ProducerConfig.MAX_BLOCK_MS_CONFIG, PATIENCE.toMillis());
        settings.put(ProducerConfig.ACKS_CONFIG, "all");
        settings.put(ProducerConfig.ENABLE_IDEMPOTENCE_CONFIG, true);
        this.producer = new KafkaProducer<>(settings, new StringSerializer(), new ByteArraySerializer());
    }

    /** Takes what an earlier host has said, null for what it took back. */
    void remember(Map<String, byte[]> records) {
        records.forEach((key, value) -> {
            try {
                said.put(key, value == null ? null : DeviceStatus.read(value));
            } catch (UnreadableException e) {
                LOG.warn("the status of {} cannot be read and is written anew: {}", key, e.getMessage());
                said.put(key, new DeviceStatus(-1, DeviceStatus.State.FAILED, ""));
            }
        });
        said.values().removeIf(Objects::isNull);
    }

    /** The devices of which a status is on the topic. */
    Set<String> keys() {
        return new HashSet<>(said.keySet());
    }

    /** @param status null for a device that is gone */
    void say(String key, DeviceStatus status) {
        if (Objects.equals(said.get(key), status)) {
            return;
        }
        if (status == null) {
            said.remove(key);
        } else {
            said.put(key, status);
        }
        send(key);
    }

    private void send(String key) {
        DeviceStatus status = said.get(key);
        byte[] value = status == null ? null : status.toBytes();
        producer.send(new ProducerRecord<>(Topics.DEVICES_STATUS, key, value), (at, failure) -> {
            if (failure != null) {
                LOG.warn("the status of {} was not written and is written again: {}", key, failure.toString());
                lost.add(key);
            }
        });
    }

    /** Says again what did not arrive. */
    void repeatLost() {
        for (String key = lost.poll(); key != null; key = lost.poll()) {
            send(key);
        }
    }

    /** Waits some seconds until all has arrived. */
    @Override
    public void close() {
        producer.close(PATIENCE);
    }
}
