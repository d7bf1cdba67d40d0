package io.furrow.control.field;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.TopicExistsException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** The topic {@code service.fields}, read to its end and written to. */
public final class FieldsTopic {
    private static final Duration PATIENCE = Duration.ofSeconds(10);

    private final Properties client;

    /** @param client settings of a Kafka client, {@code bootstrap.servers} among them */
    public FieldsTopic(Properties client) {
        this.client = client;
    }

    /**
     * Every version, in the order of their keys; none where the topic is not there. What is no version of a field is passed over, the
     * jobs report it.
     *
     * @throws IOException if Kafka does not answer; the message says what to do
     */
    public List<FieldVersion> read() throws IOException {
        Properties properties = settings();
        properties.setProperty("isolation.level", "read_committed");
        try (KafkaConsumer<String, byte[]> consumer =
                new KafkaConsumer<>(properties, new StringDeserializer(), new ByteArrayDeserializer())) {
            List<TopicPartition> all = consumer.listTopics().getOrDefault(Topics.FIELDS, List.of()).stream()
                    .map(one -> new TopicPartition(one.topic(), one.partition()))
                    .toList();
            consumer.assign(all);
            consumer.seekToBeginning(all);
            Map<TopicPartition, Long> ends = consumer.endOffsets(all);
            Map<String, FieldVersion> versions = new TreeMap<>();
            while (all.stream().anyMatch(one -> consumer.position(one) < ends.get(one))) {
                consumer.poll(Duration.ofMillis(200)).forEach(record -> keep(record, versions));
            }
            return List.copyOf(versions.values());
        } catch (KafkaException e) {
            throw away("read", e);
        }
    }

    private static void keep(ConsumerRecord<String, byte[]> record, Map<String, FieldVersion> versions) {
        try {
            if (record.value() == null) {
                versions.remove(FieldVersion.Key.parse(record.key()).toString());
            } else {
                FieldVersion version = FieldVersion.read(record.value());
                versions.put(version.key(), version);
            }
        } catch (UnreadableException e) {
            // Not ours to judge here: each job that reads the topic sends it to service.fields.dead.
        }
    }

    /**
     * Writes them in their order, making the topic where it is missing: compacted, one partition, so that a version never overtakes another.
     *
     * @throws IOException if Kafka does not take one of them; to repeat the whole is harmless
     */
    public void write(List<FieldVersion> versions) throws IOException {
        ensure();
        Properties properties = settings();
        properties.setProperty("acks", "all");
        properties.setProperty("max.in.flight.requests.per.connection", "1"); // the topic may have been made just now
        properties.setProperty("delivery.timeout.ms", "30000");
        properties.setProperty("max.block.ms", Long.toString(PATIENCE.toMillis()));
        try (KafkaProducer<String, byte[]> producer =
                new KafkaProducer<>(properties, new StringSerializer(), new ByteArraySerializer())) {
            List<Future<RecordMetadata>> sent = new ArrayList<>();
            for (FieldVersion version : versions) {
                sent.add(producer.send(new ProducerRecord<>(Topics.FIELDS, version.key(), version.toBytes())));
            }
            for (Future<RecordMetadata> one : sent) {
                one.get();
            }
        } catch (KafkaException | ExecutionException e) {
            throw away("written to", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw away("written to", e);
        }
    }

    private void ensure() throws IOException {
        NewTopic wanted = new NewTopic(Topics.FIELDS, Optional.of(1), Optional.empty())
                .configs(Map.of("cleanup.policy", "compact"));
        try (Admin admin = Admin.create(settings())) {
            admin.createTopics(List.of(wanted)).all().get(PATIENCE.toSeconds(), TimeUnit.SECONDS);
        } catch (ExecutionException e) {
            if (!(e.getCause() instanceof TopicExistsException)) {
                throw away("written to", e);
            }
        } catch (KafkaException | TimeoutException e) {
            throw away("written to", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw away("written to", e);
        }
    }

    private Properties settings() {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.setProperty("default.api.timeout.ms", Long.toString(PATIENCE.toMillis()));
        settings.setProperty("request.timeout.ms", Long.toString(PATIENCE.toMillis()));
        return settings;
    }

    private IOException away(String what, Exception cause) {
        return new IOException(
                "Kafka at %s cannot be %s (%s). Check the address given with --kafka."
                        .formatted(client.getProperty("bootstrap.servers"), what, cause.getMessage()),
                cause);
    }
}
