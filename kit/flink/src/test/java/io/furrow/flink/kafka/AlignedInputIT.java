package io.furrow.flink.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.atomic.AtomicReference;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import org.apache.flink.api.common.JobID;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(240)
@Tag("full")
class AlignedInputIT {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(1, METRICS.addToConfiguration(new Configuration()));

    private static final int BACKLOG = 300_000;
    private static final byte[] ENTITY = IntStream.range(0, 8)
            .mapToObj(i -> ",\"attribute" + i + "\":{\"type\":\"Number\",\"value\":" + i + ".25,\"metadata\":{}}")
            .collect(Collectors.joining("", "{\"id\":\"urn:ngsi-ld:T:1\",\"type\":\"T\"", "}"))
            .getBytes(UTF_8);
    private static final long HOUR = Duration.ofHours(1).toMillis();

    private KafkaProducer<byte[], byte[]> producer;

    @Test
    void readsAPartitionThatIsAheadOnlyWhenTheSlowestHasComeCloser(@TempDir Path directory) throws Exception {
        long begin = System.currentTimeMillis() - 10 * HOUR;
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            Map<String, Object> client = Map.of("bootstrap.servers", kafka.bootstrapServers());
            try (var consumer = new KafkaConsumer<>(client, new StringDeserializer(), new StringDeserializer())) {
                producer = new KafkaProducer<>(
                        kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
                kafka.createTopics(List.of(new NewTopic("in", 2, (short) 1), new NewTopic("out", 1, (short) 1)));
                consumer.assign(List.of(new TopicPartition("out", 0)));
                consumer.seekToBeginning(consumer.assignment());
                write(0, begin, "fast");
                write(1, begin, "slow");
                write(0, begin + HOUR, "fast, an hour on");

                JobClient job = job(kafka.bootstrapServers(), "out", Optional.of(Duration.ofSeconds(10)));
                try {
                    await().until(() -> waits(job.getJobID()));
                    write(0, begin + HOUR + 1, "fast, later");
                    write(1, begin + 2 * HOUR, "slow, two hours on");

                    List<String> read = new ArrayList<>();
                    await().until(() -> {
                        consumer.poll(Duration.ofMillis(200)).forEach(record -> read.add(record.value()));
                        return read.size() >= 5;
                    });
                    assertThat(read.subList(0, 3)).contains("fast", "slow", "fast, an hour on");
                    assertThat(read.subList(3, 5)).containsExactly("slow, two hours on", "fast, later");
                } finally {
                    job.cancel().get();
                    producer.close();
                }
            }
        }
    }

    /** Of a farm's rate, 125 a second: the drift of two minutes is read in a fraction of a second. */
    @Test
    void readsABacklogOfOnePartitionNearlyAsFastAsWithoutAlignment(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory)) {
            kafka.createTopics(List.of(new NewTopic("in", 1, (short) 1)));
            producer =
                    new KafkaProducer<>(kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer());
            long begin = System.currentTimeMillis() - 10 * HOUR;
            for (int i = 0; i < BACKLOG; i++) {
                producer.send(new ProducerRecord<>("in", 0, begin + i * 8L, null, ENTITY));
            }
            producer.close();
            List<Duration> free = new ArrayList<>();
            List<Duration> aligned = new ArrayList<>();
            for (int turn = 0; turn < 2; turn++) {
                free.add(read(kafka, "free-" + turn, Optional.empty()));
                aligned.add(read(kafka, "aligned-" + turn, Optional.of(Duration.ofMinutes(2))));
            }
            assertThat(Collections.min(aligned).toMillis())
                    .as("aligned %s, free %s", aligned, free)
                    .isLessThanOrEqualTo(Collections.min(free).toMillis() * 3 / 2);
        }
    }

    private Duration read(EmbeddedKafka kafka, String out, Optional<Duration> drift) throws Exception {
        kafka.createTopics(List.of(new NewTopic(out, 1, (short) 1)));
        TopicPartition written = new TopicPartition(out, 0);
        JobClient job = job(kafka.bootstrapServers(), out, drift);
        try (KafkaConsumer<String, String> consumer = new KafkaConsumer<>(
                Map.of("bootstrap.servers", kafka.bootstrapServers()),
                new StringDeserializer(),
                new StringDeserializer())) {
            await().pollInSameThread().pollInterval(Duration.ofMillis(10)).until(() -> end(consumer, written) > 0);
            long begun = System.nanoTime();
            await().pollInSameThread()
                    .pollInterval(Duration.ofMillis(10))
                    .until(() -> end(consumer, written) == BACKLOG);
            return Duration.ofNanos(System.nanoTime() - begun);
        } finally {
            job.cancel().get();
        }
    }

    private static long end(KafkaConsumer<?, ?> consumer, TopicPartition partition) {
        return consumer.endOffsets(List.of(partition)).get(partition);
    }

    /** Whether a partition was made to wait. */
    private static boolean waits(JobID job) {
        return METRICS.findMetrics(job, "accumulatedPausedTimeMs").values().stream()
                .anyMatch(metric -> metric instanceof Gauge<?> gauge && ((Number) gauge.getValue()).longValue() > 0);
    }

    private void write(int partition, long time, String value) throws Exception {
        producer.send(new ProducerRecord<>("in", partition, time, null, value.getBytes(UTF_8)))
                .get();
    }

    private static JobClient job(String servers, String out, Optional<Duration> drift) throws Exception {
        AtomicReference<JobOptions> parsed = new AtomicReference<>();
        TestJob.run(
                parsed::set,
                "copy",
                "--name",
                out,
                "--bootstrap-servers",
                servers,
                "--parallelism",
                "1",
                "--input",
                "in",
                "--idle-timeout",
                "1h");
        StreamExecutionEnvironment env = JobEnvironment.create(parsed.get());
        env.fromSource(KafkaConnectors.source(parsed.get()), KafkaConnectors.watermarks(parsed.get(), drift), "Records")
                .uid("records")
                .map(record -> {
                    for (int i = 0; i < 4 && record.value().length == ENTITY.length; i++) {
                        Entity.parse(record.value()); // as much work as a job has
                    }
                    return record.to(out);
                })
                .uid("rename-topic")
                .sinkTo(KafkaConnectors.sink(parsed.get()))
                .uid("write-records");
        return env.executeAsync();
    }
}
