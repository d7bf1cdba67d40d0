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

/** Publishes {@code service.devices.status}: a record whenever the status of a device changes. */
final class StatusRecords implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StatusRecords.class);

    private static final Duration TIMEOUT = Duration.ofSeconds(5);

    private final KafkaProducer<String, byte[]> producer;
    private final Map<String, DeviceStatus> published = new HashMap<>();
    private final Queue<String> failed = new ConcurrentLinkedQueue<>();

    StatusRecords(Properties kafka) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.putIfAbsent(ProducerConfig.MAX_BLOCK_MS_CONFIG, TIMEOUT.toMillis());
        settings.put(ProducerConfig.ACKS_CONFIG, "all");
        settings.put(ProducerConfig.ENABLE_IDEMPOTENCE_CONFIG, true);
        this.producer = new KafkaProducer<>(settings, new StringSerializer(), new ByteArraySerializer());
    }

    /** Initializes from the records of an earlier host, null for tombstones. */
    void remember(Map<String, byte[]> records) {
        records.forEach((key, value) -> {
            try {
                published.put(key, value == null ? null : DeviceStatus.read(value));
            } catch (UnreadableException e) {
                LOG.warn("the status of {} cannot be read and is replaced: {}", key, e.getMessage());
                published.put(key, new DeviceStatus(-1, DeviceStatus.State.FAILED, ""));
            }
        });
        published.values().removeIf(Objects::isNull);
    }

    /** Devices with a status on the topic. */
    Set<String> keys() {
        return new HashSet<>(published.keySet());
    }

    /**
     * Publishes a status unless it is unchanged.
     *
     * @param status null for a removed device
     */
    void publish(String key, DeviceStatus status) {
        if (Objects.equals(published.get(key), status)) {
            return;
        }
        if (status == null) {
            published.remove(key);
        } else {
            published.put(key, status);
        }
        send(key);
    }

    private void send(String key) {
        DeviceStatus status = published.get(key);
        byte[] value = status == null ? null : status.toBytes();
        producer.send(new ProducerRecord<>(Topics.DEVICES_STATUS, key, value), (at, failure) -> {
            if (failure != null) {
                LOG.warn("the status of {} was not written and is retried: {}", key, failure.toString());
                failed.add(key);
            }
        });
    }

    /** Sends failed records again. */
    void retryFailed() {
        for (String key = failed.poll(); key != null; key = failed.poll()) {
            send(key);
        }
    }

    /** Waits some seconds for outstanding records. */
    @Override
    public void close() {
        producer.close(TIMEOUT);
    }
}
