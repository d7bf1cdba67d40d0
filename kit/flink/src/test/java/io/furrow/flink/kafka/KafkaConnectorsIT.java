package io.furrow.flink.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.core.execution.JobClient;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.TransactionListing;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.TestJob;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** On the embedded broker, or on another by {@code -Dfurrow.test.kafka=HOST:PORT}, which creates topics by itself. */
@Timeout(180)
class KafkaConnectorsIT {
    @TempDir
    static Path directory;

    @AutoClose
    private static EmbeddedKafka embedded;

    private static String bootstrapServers;

    /** A record without what two copies may differ in. */
    private record Copied(String key, String value, long timestamp, Map<String, String> headers) {}

    @BeforeAll
    static void start() {
        bootstrapServers = System.getProperty("furrow.test.kafka");
        if (bootstrapServers == null) {
            embedded = EmbeddedKafka.start(directory);
            bootstrapServers = embedded.bootstrapServers();
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"at-least-once", "exactly-once"})
    void copyRecordsWithKeyValueTimestampAndHeaders(String delivery) throws Exception {
        String in = "in-" + delivery;
        String out = "out-" + delivery;
        List<Copied> sent = List.of(
                new Copied("robot:1", "{}", 1_700_000_000_000L, Map.of("ce_id", "a", "origin", "notification")),
                new Copied("robot:ñ", "binary \u0000 🚜", 0, Map.of()),
                new Copied("robot:1", null, 1_700_000_000_001L, Map.of("ce_type", "ngsi.entity.deleted")),
                new Copied(null, "no key", 5, Map.of("ñ", "ñ")));
        write(in, sent);

        JobClient job = submit(out, "copy", "--input", in, "--delivery", delivery);
        try (KafkaConsumer<byte[], byte[]> consumer = committedOf(out)) {
            List<Copied> received = new ArrayList<>();
            await().atMost(Duration.ofSeconds(90)).until(() -> {
                consumer.poll(Duration.ofMillis(200)).forEach(record -> received.add(copied(record)));
                return received.size() >= sent.size();
            });

            assertThat(received).containsExactlyInAnyOrderElementsOf(sent);
            long offsets = consumer.endOffsets(consumer.assignment()).values().stream()
                    .mapToLong(Long::longValue)
                    .sum();
            assertThat(offsets > sent.size())
                    .as("a transaction leaves a marker behind its records")
                    .isEqualTo(delivery.equals("exactly-once"));
            assertThat(received)
                    .filteredOn(copy -> "robot:1".equals(copy.key()))
                    .containsExactly(sent.get(0), sent.get(2));
        } finally {
            job.cancel().get();
        }
    }

    @Tag("full")
    @Test
    void useTransactionalIdsAgain() throws Exception {
        int rounds = 8;
        JobClient job = submit("counted", "copy", "--name", "few", "--input", "numbers", "--delivery", "exactly-once");
        try (KafkaConsumer<byte[], byte[]> consumer = committedOf("counted");
                Admin admin = Admin.create(Map.of("bootstrap.servers", bootstrapServers))) {
            for (int round = 0; round < rounds; round++) {
                write("numbers", List.of(new Copied("n", Integer.toString(round), round, Map.of())));
                await().atMost(Duration.ofSeconds(90))
                        .until(() -> !consumer.poll(Duration.ofMillis(200)).isEmpty());
            }
            List<String> ids = admin.listTransactions().all().get().stream()
                    .map(TransactionListing::transactionalId)
                    .filter(id -> id.startsWith("furrow-few:topics:"))
                    .toList();
            assertThat(ids).hasSizeBetween(1, rounds / 2);
            assertThat(admin.listConsumerGroupOffsets("furrow-few")
                            .partitionsToOffsetAndMetadata()
                            .get())
                    .isNotEmpty();
        } finally {
            job.cancel().get();
        }
    }

    @Tag("full")
    @Test
    void abortWhatAnAttemptBeforeLeftOpen() throws Exception {
        String left = "furrow-again:topics:-0-0";
        try (KafkaProducer<byte[], byte[]> lost = new KafkaProducer<>(
                Map.of("bootstrap.servers", bootstrapServers, "transactional.id", left),
                new ByteArraySerializer(),
                new ByteArraySerializer())) {
            lost.initTransactions();
            lost.beginTransaction();
            lost.send(new ProducerRecord<>("finished", utf8("k"), utf8("never committed")))
                    .get();

            write("unfinished", List.of(new Copied("k", "committed", 1, Map.of())));
            JobClient job = submit(
                    "finished", "copy", "--name", "again", "--input", "unfinished", "--delivery", "exactly-once");
            try (KafkaConsumer<byte[], byte[]> consumer = committedOf("finished")) {
                List<String> values = new ArrayList<>();
                await().atMost(Duration.ofSeconds(90)).until(() -> {
                    consumer.poll(Duration.ofMillis(200)).forEach(record -> values.add(text(record.value())));
                    return !values.isEmpty();
                });
                assertThat(values).containsExactly("committed");
            } finally {
                job.cancel().get();
            }
        }
    }

    @Tag("full")
    @Test
    void beginAtATime() throws Exception {
        write(
                "timed",
                List.of(
                        new Copied("n", "before", 1_000, Map.of()),
                        new Copied("n", "at", 2_000, Map.of()),
                        new Copied("n", "after", 3_000, Map.of())));
        JobClient job =
                submit("from-then", "copy", "--name", "then", "--input", "timed", "--from", "1970-01-01T00:00:02Z");
        try (KafkaConsumer<byte[], byte[]> consumer = committedOf("from-then")) {
            List<String> values = new ArrayList<>();
            await().atMost(Duration.ofSeconds(90)).until(() -> {
                consumer.poll(Duration.ofMillis(200)).forEach(record -> values.add(text(record.value())));
                return values.size() >= 2;
            });
            assertThat(values).containsExactly("at", "after");
        } finally {
            job.cancel().get();
        }
    }

    private static JobClient submit(String topic, String... arguments) throws Exception {
        List<StreamExecutionEnvironment> environments = new ArrayList<>();
        List<String> all = new ArrayList<>(List.of(arguments));
        all.addAll(List.of("--bootstrap-servers", bootstrapServers));
        all.addAll(List.of("--parallelism", "1", "--checkpoint-interval", "300ms"));
        TestJob.Outcome outcome =
                TestJob.run(options -> environments.add(copying(options, topic)), all.toArray(String[]::new));
        assertThat(outcome.exitCode()).as(outcome.err()).isZero();
        return environments.get(0).executeAsync();
    }

    private static StreamExecutionEnvironment copying(JobOptions options, String topic) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.fromSource(KafkaConnectors.source(options), KafkaConnectors.watermarks(options), "Records")
                .uid("read-records")
                .map(record -> record.to(topic))
                .uid("rename-topic")
                .sinkTo(KafkaConnectors.sink(options))
                .uid("write-records");
        return env;
    }

    private static void write(String topic, List<Copied> records) {
        Map<String, Object> settings =
                Map.of("bootstrap.servers", bootstrapServers, "max.in.flight.requests.per.connection", 1);
        try (var producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer())) {
            for (Copied each : records) {
                var record = new ProducerRecord<>(topic, null, each.timestamp(), utf8(each.key()), utf8(each.value()));
                each.headers().forEach((name, text) -> record.headers().add(name, utf8(text)));
                producer.send(record);
            }
        }
    }

    private static KafkaConsumer<byte[], byte[]> committedOf(String topic) {
        Map<String, Object> settings = Map.of(
                "bootstrap.servers", bootstrapServers,
                "group.id", "reader-" + topic,
                "auto.offset.reset", "earliest",
                "metadata.max.age.ms", "500",
                "isolation.level", "read_committed");
        var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        consumer.subscribe(List.of(topic));
        return consumer;
    }

    private static Copied copied(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new TreeMap<>();
        record.headers().forEach(header -> headers.put(header.key(), text(header.value())));
        return new Copied(text(record.key()), text(record.value()), record.timestamp(), headers);
    }

    private static byte[] utf8(String text) {
        return text == null ? null : text.getBytes(UTF_8);
    }

    private static String text(byte[] utf8) {
        return utf8 == null ? null : new String(utf8, UTF_8);
    }
}
