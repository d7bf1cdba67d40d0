package io.furrow.kafka.field;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.TopicExistsException;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.field.FieldArea;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
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
     * Returns all versions in the order of their keys; empty if the topic does not exist. Skips records that are not
     * versions of a field, or whose area is invalid; the jobs report them.
     *
     * @throws IOException if Kafka does not respond; the message says what to do
     */
    public List<FieldVersion> read() throws IOException {
        Map<String, FieldVersion> versions = new TreeMap<>();
        read(record -> apply(record, versions));
        return List.copyOf(versions.values());
    }

    /**
     * Returns the keys of a field's versions on the topic, including those that {@link #read} skips.
     *
     * @throws IOException if Kafka does not respond; the message says what to do
     */
    public List<String> keys(String id) throws IOException {
        Set<String> keys = new TreeSet<>();
        read(record -> {
            try {
                if (record.value() == null) {
                    keys.remove(record.key());
                } else if (key(record).id().equals(id)) {
                    keys.add(record.key());
                }
            } catch (UnreadableException e) {
                // Not the key of a version.
            }
        });
        return List.copyOf(keys);
    }

    private void read(Consumer<ConsumerRecord<String, byte[]>> records) throws IOException {
        try (CommittedReader<String> reader = CommittedReader.openExisting(settings(), Topics.FIELDS)) {
            reader.readToEnd(records::accept);
        } catch (KafkaException e) {
            throw away("read", e);
        }
    }

    private static void apply(ConsumerRecord<String, byte[]> record, Map<String, FieldVersion> versions) {
        try {
            String key = key(record).toString();
            if (record.value() == null) {
                versions.remove(key);
            } else {
                FieldVersion version = FieldVersion.read(record.value());
                if (!version.isEnd()) {
                    FieldArea.read(version.geometry(), key);
                }
                if (version.key().equals(key)) {
                    versions.put(key, version);
                }
            }
        } catch (UnreadableException e) {
            // Skipped: each job that reads the topic sends the record to service.fields.dead.
        }
    }

    /** A record without a key has none. */
    private static FieldVersion.Key key(ConsumerRecord<String, byte[]> record) throws UnreadableException {
        return FieldVersion.Key.parse(String.valueOf(record.key()));
    }

    /**
     * Writes the versions in order and creates the topic if it is missing: compacted, with one partition, so that a
     * version never overtakes another.
     *
     * @throws IOException if Kafka does not accept one of them; repeating the whole call is harmless
     */
    public void write(List<FieldVersion> versions) throws IOException {
        write(new FieldEdit(versions, List.of()));
    }

    /** Writes an edit; versions are removed after all others are written. */
    public void write(FieldEdit edit) throws IOException {
        Map<String, byte[]> records = new LinkedHashMap<>();
        edit.written().forEach(version -> records.put(version.key(), version.toBytes()));
        edit.removed().forEach(key -> records.put(key, null));
        if (records.isEmpty()) {
            return;
        }
        ensure();
        Properties properties = settings();
        properties.setProperty("acks", "all");
        properties.setProperty("max.in.flight.requests.per.connection", "1"); // the topic may have just been created
        properties.setProperty("delivery.timeout.ms", "30000");
        properties.setProperty("max.block.ms", Long.toString(TIMEOUT.toMillis()));
        try (KafkaProducer<String, byte[]> producer = KafkaClients.producer(properties)) {
            List<Future<RecordMetadata>> sent = new ArrayList<>();
            records.forEach((key, value) -> sent.add(producer.send(new ProducerRecord<>(Topics.FIELDS, key, value))));
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
        NewTopic desired = new NewTopic(Topics.FIELDS, Optional.of(1), Optional.empty())
                .configs(Map.of("cleanup.policy", "compact"));
        try (Admin admin = Admin.create(settings())) {
            admin.createTopics(List.of(desired)).all().get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
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
                        .formatted(client.getProperty("bootstrap.servers"), what, FailureText.of(cause)),
                cause);
    }
}
