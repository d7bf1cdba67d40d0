package io.furrow.mission.topic;

import java.io.IOException;
import java.nio.channels.ClosedByInterruptException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.InterruptException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.Recordings;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.file.FileRecordings;
import io.furrow.model.text.FailureText;

/**
 * Opens topics of events, {@code data.*}, as recordings: the committed records up to the end that the topic has when it
 * is opened. Event time is the record's timestamp; the event id is the header {@code ce_id}, or topic, partition and
 * offset without one; the value is an entity in normalized form, or null for a deletion. Other records are skipped and
 * counted. Opening reads the whole topic and sorts it on disk, which needs twice its size and some free space; the file
 * is deleted when the recording is closed, or, after its process was killed, when another topic is opened.
 *
 * @param kafka settings of a consumer: {@code bootstrap.servers}, security, and {@code default.api.timeout.ms}, the
 * timeout of requests, 30 s by default
 * @param until event time, epoch ms, exclusive: a topic that is still written to is the same recording when it is
 * opened again, except for late events and those that retention deletes
 * @param folder for temporary files, created if it does not exist
 */
public record TopicRecordings(TreeMap<String, String> kafka, long until, String folder) implements Recordings {
    private static final String EVENTS = "data.";
    private static final String TIMEOUT_MILLIS = "30000";
    private static final long SORTED_BYTES = 32L * 1024 * 1024;
    private static final int FETCH_BYTES = 8 * 1024 * 1024;

    /** Uses Java's folder for temporary files. */
    public TopicRecordings(Map<String, String> kafka, long until) {
        this(new TreeMap<>(kafka), until, System.getProperty("java.io.tmpdir"));
    }

    /**
     * Opens a topic; empty if it does not exist.
     *
     * @throws RecordingDeletedException if it is not a topic of events, or too large for the disk
     * @throws RecordingInterruptedException if the thread is interrupted
     * @throws RecordingException if Kafka or the disk is unavailable
     */
    @Override
    public Optional<Recording> open(String topic) throws RecordingException {
        return open(topic, DiskSpace::of);
    }

    /** Determines the disk space for the files in a folder. */
    interface SpaceOf {
        DiskSpace in(Path folder) throws IOException;
    }

    Optional<Recording> open(String topic, SpaceOf diskSpace) throws RecordingException {
        if (!topic.startsWith(EVENTS)) {
            throw new RecordingDeletedException(
                    "Topic %s holds no events; name one that begins with %s".formatted(topic, EVENTS));
        }
        TemporaryFolder temporary = null;
        Recording opened = null;
        try (KafkaConsumer<byte[], byte[]> consumer = new KafkaConsumer<>(settings())) {
            List<TopicPartition> partitions = consumer.partitionsFor(topic).stream()
                    .map(partition -> new TopicPartition(topic, partition.partition()))
                    .toList();
            if (partitions.isEmpty()) {
                return Optional.empty();
            }
            temporary = TemporaryFolder.in(Path.of(folder));
            opened = sort(topic, new Input(consumer, partitions, temporary, diskSpace.in(temporary.path())));
            return Optional.of(opened);
        } catch (RecordingException e) {
            throw e;
        } catch (InterruptException | ClosedByInterruptException e) {
            throw RecordingInterruptedException.of(e);
        } catch (KafkaException e) {
            throw new RecordingException(
                    "Topic %s cannot be read from %s: %s. Check that Kafka runs there and answers."
                            .formatted(topic, this, FailureText.of(e)),
                    e);
        } catch (IOException e) {
            throw new RecordingException(
                    "Topic %s cannot be sorted in %s: %s. Check that the folder can be written and has room."
                            .formatted(topic, folder, FailureText.of(e)),
                    e);
        } finally {
            if (temporary != null && opened == null) {
                temporary.close();
            }
        }
    }

    /** The input of the sort. */
    private record Input(
            KafkaConsumer<byte[], byte[]> consumer,
            List<TopicPartition> partitions,
            TemporaryFolder folder,
            DiskSpace diskSpace) {}

    private Recording sort(String topic, Input input) throws IOException {
        EventSorter sorter = new EventSorter(input.diskSpace(), SORTED_BYTES);
        EventTopicReader reader = new EventTopicReader(input.consumer(), input.partitions(), until, sorter);
        String timeout = kafka.getOrDefault(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, TIMEOUT_MILLIS);
        reader.read(Duration.ofMillis(Long.parseLong(timeout)));
        Path lines = input.folder().path().resolve("events.ndjson");
        sorter.writeLines(lines);
        List<SkippedRecords> skipped = reader.skipped() == 0
                ? List.of()
                : List.of(new SkippedRecords(
                        "records of " + topic, "the first is " + reader.example(), reader.skipped()));
        Recording events = new FileRecordings(lines.toString()).open(topic).orElseThrow();
        return new TopicRecording(events, input.folder(), skipped);
    }

    private Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, TIMEOUT_MILLIS);
        settings.putAll(kafka);
        settings.setProperty(ConsumerConfig.KEY_DESERIALIZER_CLASS_CONFIG, ByteArrayDeserializer.class.getName());
        settings.setProperty(ConsumerConfig.VALUE_DESERIALIZER_CLASS_CONFIG, ByteArrayDeserializer.class.getName());
        settings.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        settings.setProperty(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, "false");
        settings.setProperty(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, "false");
        settings.setProperty(ConsumerConfig.AUTO_OFFSET_RESET_CONFIG, "earliest"); // retention may delete records
        settings.setProperty(ConsumerConfig.FETCH_MAX_WAIT_MS_CONFIG, "10"); // closing waits for a pending fetch
        settings.setProperty(ConsumerConfig.FETCH_MAX_BYTES_CONFIG, String.valueOf(FETCH_BYTES));
        return settings;
    }

    /** Returns the bootstrap servers without the password. */
    @Override
    public String toString() {
        return "Kafka at " + kafka.get(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG);
    }
}
