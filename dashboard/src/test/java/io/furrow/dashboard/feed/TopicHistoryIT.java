package io.furrow.dashboard.feed;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.admin.RecordsToDelete;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class TopicHistoryIT {
    private static final long TIME = 1_777_600_000_000L;
    private static final int ALL = 5_000;

    @TempDir
    static Path directory;

    private static EmbeddedKafka kafka;
    private static KafkaProducer<String, byte[]> producer;
    private static Admin admin;

    @BeforeAll
    static void start() {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        producer = new KafkaProducer<>(kafka.producerSettings(), new StringSerializer(), new ByteArraySerializer());
        admin = Admin.create(kafka.client());
    }

    @AfterAll
    static void stop() {
        admin.close();
        producer.close();
        kafka.close();
    }

    private static void topic(String name, int partitions) throws Exception {
        kafka.createTopics(List.of(
                new NewTopic(name, Optional.of(partitions), Optional.empty()).configs(Map.of("retention.ms", "-1"))));
    }

    private static void send(String topic, int partition, long after, String value) throws Exception {
        byte[] bytes = value == null ? null : value.getBytes(UTF_8);
        producer.send(new ProducerRecord<>(topic, partition, TIME + after, "k", bytes))
                .get();
    }

    private static String encounter(String id, int n) {
        return "{\"encounter\":{\"type\":\"Text\",\"value\":\"%s\"},\"n\":%d}".formatted(id, n);
    }

    private static TopicHistory.Answer read(TopicHistory.Range range, TopicHistory.Limits limits) {
        return new TopicHistory(kafka.client(), limits, 1024 * 1024).read(range);
    }

    private static List<Integer> numbers(TopicHistory.Answer answer) throws Exception {
        List<Integer> numbers = new ArrayList<>();
        for (FeedRecord record : answer.records()) {
            JsonNode envelope = NgsiJson.read(record.envelope().getBytes(UTF_8));
            numbers.add(envelope.at("/value/n").asInt());
        }
        return numbers;
    }

    @Test
    void returnsTheRecordsOfAPeriod() throws Exception {
        topic("data.period", 2);
        for (int n = 0; n < 10; n++) {
            send("data.period", n % 2, n * 1_000L, "{\"n\":%d}".formatted(n));
        }
        send("data.period", 0, 3_500, "{\"n\":35}"); // late
        send("data.period", 0, 3_600, null);

        TopicHistory.Answer part = read(
                new TopicHistory.Range("data.period", TIME + 3_000, TIME + 6_000, null, ALL),
                TopicHistory.Limits.DEFAULT);
        assertThat(numbers(part)).as("0 for the deletion").containsExactlyInAnyOrder(3, 4, 5, 35, 0);
        assertThat(part.since()).isEqualTo(TIME + 3_000);

        TopicHistory.Answer nothing = read(
                new TopicHistory.Range("data.period", TIME + 60_000, TIME + 70_000, null, ALL),
                TopicHistory.Limits.DEFAULT);
        assertThat(nothing.records()).isEmpty();
        assertThat(nothing.since()).isEqualTo(TIME + 60_000);
    }

    @Test
    void returnsTheNewestRecordOfEachValueOfAnAttribute() throws Exception {
        topic("data.newest", 1);
        send("data.newest", 0, 0, encounter("a", 1));
        send("data.newest", 0, 1, encounter("b", 2));
        send("data.newest", 0, 2, encounter("a", 3));
        send("data.newest", 0, 3, "{\"n\":4}");
        send("data.newest", 0, 4, "{\"n\":5}");
        send("data.newest", 0, 5, "no JSON");
        send("data.newest", 0, 6, "{\"n\":6,\"encounter\":\"plain\"}");
        send("data.newest", 0, 7, "{\"n\":7,\"encounter\":\"plain\"}");
        send("data.newest", 0, 8, null);
        send("data.newest", 0, 9, "{\"n\":8,\"type\":\"Camera\",\"encounter\":\"plain\"}");
        ProducerRecord<String, byte[]> ofAnotherTenant = new ProducerRecord<>(
                "data.newest", 0, TIME + 9, "k", encounter("a", 9).getBytes(UTF_8));
        ofAnotherTenant.headers().add("fiware-service", "other".getBytes(UTF_8));
        producer.send(ofAnotherTenant).get();

        TopicHistory.Answer answer = read(
                new TopicHistory.Range("data.newest", TIME, TIME + 10, "encounter", ALL), TopicHistory.Limits.DEFAULT);
        assertThat(numbers(answer)).containsExactly(2, 3, 4, 5, 0, 7, 8, 9);
    }

    @Test
    void omitsTheOldestRecordsBeyondALimitAndReportsSinceWhenItIsComplete() throws Exception {
        topic("data.many", 1);
        for (int n = 0; n < 100; n++) {
            send("data.many", 0, n, "{\"n\":%d,\"filler\":\"%s\"}".formatted(n, "x".repeat(1_000)));
        }
        TopicHistory.Range all = new TopicHistory.Range("data.many", TIME, TIME + 1_000, null, ALL);

        TopicHistory.Answer limited =
                read(new TopicHistory.Range("data.many", TIME, TIME + 1_000, null, 10), TopicHistory.Limits.DEFAULT);
        assertThat(numbers(limited)).hasSize(10).startsWith(90).endsWith(99);
        assertThat(limited.since()).isEqualTo(TIME + 90);

        TopicHistory.Answer scanned = read(all, new TopicHistory.Limits(20, 1_000_000, Duration.ofSeconds(10)));
        assertThat(numbers(scanned)).hasSize(20).startsWith(80);
        assertThat(scanned.since()).isEqualTo(TIME + 80);

        TopicHistory.Answer limitedBytes = read(all, new TopicHistory.Limits(1_000, 10_000, Duration.ofSeconds(10)));
        assertThat(numbers(limitedBytes)).hasSize(9).startsWith(91);
        assertThat(limitedBytes.since()).isEqualTo(TIME + 91);
    }

    @Test
    void omitsTheOldestRecordsOfAllPartitions() throws Exception {
        topic("data.parted", 4);
        for (int n = 0; n < 400; n++) {
            send("data.parted", n % 4, n, "{\"n\":%d}".formatted(n));
        }

        TopicHistory.Answer limited =
                read(new TopicHistory.Range("data.parted", TIME, TIME + 1_000, null, 40), TopicHistory.Limits.DEFAULT);

        assertThat(numbers(limited))
                .containsExactlyInAnyOrderElementsOf(
                        IntStream.range(360, 400).boxed().toList());
        assertThat(limited.since()).isEqualTo(TIME + 360);
    }

    @Test
    void reportsTheTimeOfTheOldestRetainedRecord() throws Exception {
        topic("data.short", 1);
        for (int n = 0; n < 10; n++) {
            send("data.short", 0, n * 1_000L, "{\"n\":%d}".formatted(n));
        }
        admin.deleteRecords(Map.of(new TopicPartition("data.short", 0), RecordsToDelete.beforeOffset(4)))
                .all()
                .get();

        TopicHistory.Answer answer =
                read(new TopicHistory.Range("data.short", TIME, TIME + 60_000, null, ALL), TopicHistory.Limits.DEFAULT);
        assertThat(numbers(answer)).containsExactly(4, 5, 6, 7, 8, 9);
        assertThat(answer.since()).isEqualTo(TIME + 4_000);
    }
}
