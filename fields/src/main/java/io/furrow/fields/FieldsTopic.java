package io.furrow.fields;

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
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.TopicExistsException;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads the topic {@code service.fields} to its end and writes to it. */
public final class FieldsTopic {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);

    private final Properties client;

    /** @param client settings of Kafka clients, including {@code bootstrap.servers} */
    public FieldsTopic(Properties client) {
        this.client = client;
    }

    /**
     * Returns all versions in the order of their keys; none if the topic does not exist. Skips records that are not
     * versions of a field; the jobs report them.
     *
     * @throws IOException if Kafka does not respond; the message says what to do
     */
    public List<FieldVersion> read() throws IOException {
        Map<String, FieldVersion> versions = new TreeMap<>();
        try (CommittedReader<String> reader = CommittedReader.openExisting(settings(), Topics.FIELDS)) {
            reader.readToEnd(record -> apply(record, versions));
            return List.copyOf(versions.values());
        } catch (KafkaException e) {
            throw away("read", e);
        }
    }

    private static void apply(ConsumerRecord<String, byte[]> record, Map<String, FieldVersion> versions) {
        try {
            if (record.value() == null) {
                versions.remove(FieldVersion.Key.parse(record.key()).toString());
            } else {
                FieldVersion version = FieldVersion.read(record.value());
                versions.put(version.key(), version);
            }
        } catch (UnreadableException e) {
            // Skipped: each job that reads the topic sends the record to service.fields.dead.
        }
    }

    /**
     * Writes the versions in order and creates the topic if it is missing: compacted, with one partition, so that a
     * version never overtakes another.
     *
     * @throws IOException if Kafka does not accept one of them; repeating the whole call is harmless
     */
    public void write(List<FieldVersion> versions) throws IOException {
        ensure();
        Properties properties = settings();
        properties.setProperty("acks", "all");
        properties.setProperty("max.in.flight.requests.per.connection", "1"); // the topic may have just been created
        properties.setProperty("delivery.timeout.ms", "30000");
        properties.setProperty("max.block.ms", Long.toString(TIMEOUT.toMillis()));
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
            admin.createTopics(List.of(wanted)).all().get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
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
        settings.setProperty("default.api.timeout.ms", Long.toString(TIMEOUT.toMillis()));
        settings.setProperty("request.timeout.ms", Long.toString(TIMEOUT.toMillis()));
        return settings;
    }

    private IOException away(String what, Exception cause) {
        return new IOException(
                "Kafka at %s cannot be %s (%s). Check the address given with --kafka."
                        .formatted(client.getProperty("bootstrap.servers"), what, cause.getMessage()),
                cause);
    }
}
