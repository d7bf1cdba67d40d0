package io.furrow.launcher.status;

import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.function.BiConsumer;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads averages and collisions from its creation on, on its own thread. */
final class Results implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Results.class);

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final BiConsumer<Entity, FiwareScope> listener;
    private final Thread thread = new Thread(this::read, "status-results");

    /** @param listener receives each result entity and its scope, always on the same thread */
    Results(Properties client, BiConsumer<Entity, FiwareScope> listener) {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.setProperty("isolation.level", "read_committed");
        properties.setProperty("auto.offset.reset", "latest");
        this.consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        this.listener = listener;
    }

    void start() {
        List<TopicPartition> partitions = List.of(Topics.TEMPERATURE, Topics.COLLISION).stream()
                .flatMap(topic -> consumer.partitionsFor(topic).stream())
                .map(info -> new TopicPartition(info.topic(), info.partition()))
                .toList();
        consumer.assign(partitions);
        consumer.seekToEnd(partitions);
        thread.setDaemon(true);
        thread.start();
    }

    private void read() {
        try (consumer) {
            while (true) {
                consumer.poll(Duration.ofMillis(500)).forEach(this::report);
            }
        } catch (WakeupException e) {
            LOG.debug("closed", e);
        }
    }

    private void report(ConsumerRecord<byte[], byte[]> record) {
        try {
            listener.accept(Entity.parse(record.value()), KafkaClients.scope(record.headers()));
        } catch (UnreadableException e) {
            LOG.warn("{}-{}@{} is not an entity", record.topic(), record.partition(), record.offset(), e);
        }
    }

    @Override
    public void close() {
        consumer.wakeup();
    }
}
