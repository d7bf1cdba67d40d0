package io.furrow.ingest;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.function.Predicate;
import java.util.stream.Collectors;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.awaitility.core.ConditionTimeoutException;

import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.event.HeaderNames;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A Kafka broker and a Flink cluster for the time of a test, and the job {@code ingest} on them. */
final class KafkaSuite implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    private static final int SLOTS = 4;

    private final EmbeddedKafka kafka;
    private final EmbeddedFlink flink;
    private final KafkaProducer<byte[], byte[]> producer;
    private final Admin admin;
    /** Why a record was not written, the last that was not; else null. */
    private volatile Exception unwritten;

    private KafkaSuite(EmbeddedKafka kafka, EmbeddedFlink flink) {
        this.kafka = kafka;
        this.flink = flink;
        this.producer =
                new KafkaProducer<>(kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
        this.admin = Admin.create(kafka.client());
    }

    static KafkaSuite start(Path directory) {
        return new KafkaSuite(EmbeddedKafka.start(directory), EmbeddedFlink.start(SLOTS, 0));
    }

    String bootstrapServers() {
        return kafka.bootstrapServers();
    }

    Admin admin() {
        return admin;
    }

    /** Keeps records of any time: retention goes by the record timestamp. */
    void makeTopic(String name, int partitions) throws Exception {
        makeTopic(name, partitions, Map.of());
    }

    void makeTopic(String name, int partitions, Map<String, String> settings) throws Exception {
        Map<String, String> all = new HashMap<>(settings);
        all.put("retention.ms", "-1");
        NewTopic topic = new NewTopic(name, Optional.of(partitions), Optional.empty());
        kafka.createTopics(List.of(topic.configs(all)));
    }

    /** @param partition null for that of the key */
    void write(String topic, Integer partition, long time, String key, String value, Map<String, String> headers) {
        ProducerRecord<byte[], byte[]> record =
                new ProducerRecord<>(topic, partition, time, utf8(key), value == null ? null : utf8(value));
        headers.forEach((name, text) -> record.headers().add(name, utf8(text)));
        producer.send(record, (written, failure) -> {
            if (failure != null) {
                unwritten = failure;
            }
        });
    }

    /** Starts the job, from a savepoint where one is given; a part of it from a savepoint of more. */
    JobID run(String savepoint, String... args) {
        IngestOptions options = new IngestOptions();
        List<String> all = new ArrayList<>(List.of(args));
        all.addAll(List.of("--bootstrap-servers", kafka.bootstrapServers(), "--checkpoint-interval", "500ms"));
        JobCommandLine.of(options).parseArgs(all.toArray(String[]::new));
        StreamGraph graph = IngestJob.assemble(options).getStreamGraph();
        if (savepoint != null) {
            graph.setSavepointRestoreSettings(
                    SavepointRestoreSettings.forPath(savepoint, all.contains("--parts"), RecoveryClaimMode.NO_CLAIM));
        }
        return flink.submit(graph);
    }

    /** Where the savepoint is with which the job ended. */
    String stop(JobID job, Path directory) throws Exception {
        return flink.cluster()
                .stopWithSavepoint(job, directory.toUri().toString(), false, SavepointFormatType.CANONICAL)
                .get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
    }

    JobStatus status(JobID job) {
        return flink.status(job);
    }

    void cancel(JobID job) throws Exception {
        flink.cluster().cancelJob(job).get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
        await().atMost(TIMEOUT).until(() -> flink.status(job).isGloballyTerminalState());
    }

    /** The committed records of a topic, as soon as there are so many. */
    List<ConsumerRecord<byte[], byte[]>> awaitRecords(String topic, int atLeast) {
        return awaitRecords(topic, record -> true, atLeast);
    }

    /** The same of the records that count. */
    List<ConsumerRecord<byte[], byte[]>> awaitRecords(
            String topic, Predicate<ConsumerRecord<byte[], byte[]>> counts, int atLeast) {
        producer.flush();
        assertThat(unwritten).as("a record that was not written").isNull();
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (CommittedReader<byte[]> reader = CommittedReader.openBytes(kafka.client(), topic)) {
            await().atMost(TIMEOUT).until(() -> {
                if (reader.assign(List.of(topic))) {
                    for (ConsumerRecord<byte[], byte[]> record : reader.poll(Duration.ofMillis(100))) {
                        if (counts.test(record)) {
                            records.add(record);
                        }
                    }
                }
                return records.size() >= atLeast;
            });
        } catch (ConditionTimeoutException e) {
            throw new AssertionError(
                    "%d of %d records on %s; the jobs: %s".formatted(records.size(), atLeast, topic, jobs()), e);
        }
        return records;
    }

    private List<String> jobs() {
        return flink.cluster().listJobs().join().stream()
                .map(job -> job.getJobName() + " " + job.getJobState())
                .toList();
    }

    /** The ids of the events. */
    static Set<String> ids(List<ConsumerRecord<byte[], byte[]>> records) {
        return records.stream()
                .map(record -> headers(record).get(HeaderNames.CE_ID))
                .collect(Collectors.toSet());
    }

    static Map<String, String> headers(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new HashMap<>();
        for (Header header : record.headers()) {
            headers.put(header.key(), new String(header.value(), UTF_8));
        }
        return headers;
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }

    @Override
    public void close() {
        producer.close(Duration.ofSeconds(1));
        admin.close(Duration.ofSeconds(1));
        flink.close();
        kafka.close();
    }
}
