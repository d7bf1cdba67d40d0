package io.furrow.analytics.temperature;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.analytics.field.FieldRecords;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The job as it is started, between the topics of a real broker. */
@Timeout(120)
class TemperatureJobIT {
    /** Event time between two rounds, ms. */
    private static final long ROUND = 1_000_000;

    /** A topic that ingest does not read. */
    private static final String OTHER = "reports";

    private static final byte[] GARBAGE = "temperature=18".getBytes(UTF_8);

    @Tag("full")
    @Test
    void readsReportedChangesAndWritesAveragesAndDeadLetters(@TempDir Path dir) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(dir.resolve("kafka"));
                EmbeddedFlink flink = EmbeddedFlink.start(1, 0)) {
            makeTopics(kafka);
            List<TopicRecord> reported = new ArrayList<>(Farm.FOUR_DEVICES_ONE_DEFECTIVE);
            reported.add(Farm.garbage(GARBAGE, 5_000).to(OTHER));
            reported.add(Farm.north("t1", 18, 200_000));
            write(kafka, reported);

            flink.submit(TemperatureJob.assemble(Farm.options(
                            Farm.FIELDS,
                            "--bootstrap-servers",
                            kafka.bootstrapServers(),
                            "--input",
                            Topics.RAW + "," + OTHER,
                            "--idle-timeout",
                            "2s",
                            "--parallelism",
                            "1"))
                    .getStreamGraph());

            ConsumerRecord<byte[], byte[]> result = first(kafka, Topics.TEMPERATURE);
            assertThat(Entity.parse(result.value()).number("averageTemperature"))
                    .contains(19.0);
            assertThat(result.key()).isEqualTo("north".getBytes(UTF_8));
            assertThat(result.timestamp()).isEqualTo(59_999);
            assertThat(header(result, HeaderNames.CE_SOURCE)).isEqualTo("/analytics/temperature");

            ConsumerRecord<byte[], byte[]> dead = first(kafka, Topics.dead(OTHER));
            assertThat(dead.value()).isEqualTo(GARBAGE);
            assertThat(header(dead, DeadLetter.SOURCE)).matches("reports-\\d@\\d+");
        }
    }

    /** Each reading is written once the one before it has shown, in a result, that the fields are so. */
    @Tag("full")
    @Test
    void goesByTheFieldsAsTheyComeChangeAndGo(@TempDir Path dir) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(dir.resolve("kafka"));
                EmbeddedFlink flink = EmbeddedFlink.start(1, 0)) {
            makeTopics(kafka);
            FieldRecords fields = new FieldRecords();
            write(kafka, List.of(fields.square("north", 0, "a")));
            flink.submit(TemperatureJob.assemble(onTopics(kafka)).getStreamGraph());
            try (var results = consumer(kafka, Topics.TEMPERATURE)) {
                averages(kafka, results, 0, "north a");
                write(kafka, List.of(fields.square("south", 0, "b")));
                averages(kafka, results, 1, "north a", "south b");
                write(kafka, List.of(fields.square("south", 0, "c")));
                averages(kafka, results, 2, "north a", "south c");
                write(kafka, List.of(fields.takeAway("north", 0)));
                averages(kafka, results, 3, "south c");
                write(kafka, List.of(fields.end("south", 4 * ROUND), fields.square("east", 4 * ROUND, "e")));
                averages(kafka, results, 4, "east e");
            }
        }
    }

    /**
     * Reports, second by second of event time, until a window of the round shows these fields and their domains; what the job had not
     * read yet of the fields shows in the next.
     */
    private static void averages(
            EmbeddedKafka kafka, KafkaConsumer<byte[], byte[]> results, int round, String... expected) {
        AtomicLong second = new AtomicLong(round * ROUND);
        TreeMap<Double, TreeSet<String>> windows = new TreeMap<>();
        await().pollInSameThread().until(() -> {
            write(kafka, List.of(Farm.reading("t1", 18, 55, 15, second.getAndAdd(1_000))));
            for (ConsumerRecord<byte[], byte[]> record : results.poll(Duration.ofMillis(100))) {
                Entity result = Entity.parse(record.value());
                windows.computeIfAbsent(result.number("windowStart").orElseThrow(), start -> new TreeSet<>())
                        .add(result.text("field").orElseThrow() + " "
                                + result.text("Domain").orElse(""));
            }
            return windows.tailMap((double) (round * ROUND)).containsValue(new TreeSet<>(List.of(expected)));
        });
        assertThat(second.get()).as("event time of a round").isLessThan((round + 1) * ROUND);
    }

    /** They keep records of 1970: retention goes by the record timestamp. */
    private static void makeTopics(EmbeddedKafka kafka) throws Exception {
        kafka.createTopics(Stream.of(Topics.RAW, OTHER, Topics.FIELDS, Topics.TEMPERATURE, Topics.dead(OTHER))
                .map(name -> new NewTopic(name, Optional.of(1), Optional.empty()).configs(Map.of("retention.ms", "-1")))
                .toList());
    }

    private static TemperatureOptions onTopics(EmbeddedKafka kafka) {
        TemperatureOptions options = new TemperatureOptions();
        JobCommandLine.of(options)
                .parseArgs(
                        "--bootstrap-servers", kafka.bootstrapServers(),
                        "--idle-timeout", "2s",
                        "--parallelism", "1",
                        "--window", "1s",
                        "--out-of-orderness", "0s");
        return options;
    }

    private static void write(EmbeddedKafka kafka, List<TopicRecord> records) {
        try (var producer =
                new KafkaProducer<>(kafka.producerSettings(), new ByteArraySerializer(), new ByteArraySerializer())) {
            for (TopicRecord record : records) {
                var out = new ProducerRecord<>(record.topic(), null, record.timestamp(), record.key(), record.value());
                record.headers().forEach((name, text) -> out.headers().add(name, text.getBytes(UTF_8)));
                producer.send(out);
            }
            producer.flush();
        }
    }

    private static KafkaConsumer<byte[], byte[]> consumer(EmbeddedKafka kafka, String topic) {
        KafkaConsumer<byte[], byte[]> consumer = new KafkaConsumer<>(
                Map.of(
                        "bootstrap.servers",
                        kafka.bootstrapServers(),
                        "group.id",
                        "reader-of-" + topic,
                        "auto.offset.reset",
                        "earliest",
                        "metadata.max.age.ms",
                        "1000"),
                new ByteArrayDeserializer(),
                new ByteArrayDeserializer());
        consumer.subscribe(List.of(topic));
        return consumer;
    }

    private static ConsumerRecord<byte[], byte[]> first(EmbeddedKafka kafka, String topic) {
        try (var consumer = consumer(kafka, topic)) {
            // A consumer is used from one thread only.
            return await().pollInSameThread()
                    .until(() -> consumer.poll(Duration.ofMillis(200)), polled -> !polled.isEmpty())
                    .iterator()
                    .next();
        }
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return new String(header.value(), UTF_8);
    }
}
