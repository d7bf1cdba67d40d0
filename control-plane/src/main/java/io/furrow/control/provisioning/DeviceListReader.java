package io.furrow.control.provisioning;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.function.BiConsumer;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import io.furrow.model.topic.Topics;

/** Follows {@code service.missions.devices} from its beginning, beside the topic that decides which instance is at work. For one thread. */
final class DeviceListReader implements AutoCloseable {
    private final KafkaConsumer<String, byte[]> consumer;
    private final BiConsumer<String, byte[]> lists;
    private Map<TopicPartition, Long> unread;

    /** @param lists takes each part; null for one that was deleted */
    DeviceListReader(Properties client, BiConsumer<String, byte[]> lists) {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.remove("group.id");
        settings.setProperty("isolation.level", "read_committed");
        settings.setProperty("enable.auto.commit", "false");
        settings.setProperty("auto.offset.reset", "earliest");
        this.consumer = new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer());
        this.lists = lists;
    }

    /** Begins at the beginning. */
    void rewind() {
        List<TopicPartition> all = consumer.partitionsFor(Topics.MISSION_DEVICES).stream()
                .map(each -> new TopicPartition(each.topic(), each.partition()))
                .toList();
        consumer.assign(all);
        consumer.seekToBeginning(all);
        unread = new java.util.HashMap<>(consumer.endOffsets(all));
    }

    /** Takes what has come, without waiting for more. Answers whether it took anything. */
    boolean poll() {
        if (unread == null) {
            return false;
        }
        boolean taken = false;
        for (ConsumerRecord<String, byte[]> record : consumer.poll(Duration.ZERO)) {
            lists.accept(record.key(), record.value());
            taken = true;
        }
        unread.entrySet().removeIf(end -> consumer.position(end.getKey()) >= end.getValue());
        return taken;
    }

    /** Whether all that was there when it began has been taken. */
    boolean isCaughtUp() {
        return unread != null && unread.isEmpty();
    }

    @Override
    public void close() {
        consumer.close();
    }
}
