package io.furrow.suite;

import org.junit.jupiter.api.AutoClose;
import static java.nio.charset.StandardCharsets.UTF_8;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.StringSerializer;
import org.assertj.core.api.ThrowingConsumer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.load.LoadFleet;
import io.furrow.simulators.load.LoadPlan;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** What goes wrong in the field, each with its outcome; after each of them a good event still comes through. */
@Tag("full")
class BadInputIT {
    private static final long MILLIS_2023 = 1_700_000_000_000L;

    @AutoClose
    private static RunningSuite running;

    private static int goodOnes;

    @BeforeAll
    static void start() throws Exception {
        running = RunningSuite.start(null);
    }

    @AfterEach
    void aGoodEventStillComesThrough() throws Exception {
        String id = "good-" + goodOnes++;
        assertThat(running.ngsi().append(entity(id, "\"n\":{\"type\":\"Number\",\"value\":1}")))
                .isEqualTo(204);
        awaitRouted(id, record -> assertThat(record.value()).isNotEmpty());
    }

    @ParameterizedTest
    @CsvSource({
        "no JSON, 400, not-json",
        "no entity, 400, not-an-entity",
        "ten megabytes, 413, too-large",
        "deeply nested, 400, too-deep"
    })
    void setsAsideANotificationThatCannotBeRead(String kind, int status, String reason) throws Exception {
        assertThat(running.ngsi().notify(unreadable(kind))).isEqualTo(status);

        awaitDeadLetter(reason, "ngsi-source");
    }

    @Test
    void setsAsideARecordOfAnotherSchema() throws Exception {
        try (KafkaProducer<String, String> producer = new KafkaProducer<>(
                running.suite().kafka().clientProperties(), new StringSerializer(), new StringSerializer())) {
            producer.send(new ProducerRecord<>("data.raw", "other", "{\"schema\":{\"type\":\"int32\"},\"payload\":7}"))
                    .get();
        }

        awaitDeadLetter("not-an-entity", "ingest");
    }

    @Test
    void setsAsideAResultThatTheContextBrokerRejects() throws Exception {
        try (KafkaProducer<String, String> producer = new KafkaProducer<>(
                running.suite().kafka().clientProperties(), new StringSerializer(), new StringSerializer())) {
            for (String text : List.of("(refused)", "accepted")) {
                ProducerRecord<String, String> result = new ProducerRecord<>("data.context", 0, text, result(text));
                result.headers().add(HeaderNames.SERVICE, "farm".getBytes(UTF_8));
                producer.send(result).get();
            }
        }

        await()
                .untilAsserted(
                        () -> assertThat(running.ngsi().entities("id=accepted")).hasSize(1));
        try (TopicLog dead = running.topic("ngsi-sink.dead")) {
            await()
                    .untilAsserted(() -> assertThat(dead.of("(refused)")).hasSize(1));
        }
    }

    @ParameterizedTest
    @CsvSource({"NaN, -3.483", "-3.483, 40.3134", "0, 0", "95, -3.483"})
    void routesADeviceWithoutAUsablePositionAndLeavesItOutOfTheAverage(String latitude, String longitude)
            throws Exception {
        String id = "lost-" + latitude;
        String good = "found-" + latitude;

        assertThat(running.ngsi().append(thermometer(id, 99, latitude, longitude)))
                .isEqualTo(204);
        awaitRouted(
                id,
                record -> assertThat(Entity.parse(record.value()).number("Temperature"))
                        .contains(99.0));

        // The good one reports until a window that holds it has closed; the lost one is never part of it.
        await().pollInterval(Duration.ofMillis(300)).untilAsserted(() -> {
            double reading = 20 + System.nanoTime() % 1000 / 1e6;
            running.ngsi().append(thermometer(id, 99 + reading / 1000, latitude, longitude));
            running.ngsi().append(thermometer(good, reading, "40.3134", "-3.483"));
            assertThat(running.ngsi().entity("Analytics:FieldTemperature:field-1").at("/plainMean/value")
                            .asDouble())
                    .isBetween(19.9, 20.2);
        });
    }

    @Test
    void takesTheTimeOfReceiptForATimeInTheFuture() throws Exception {
        long before = System.currentTimeMillis();
        send("future", "\"Time\":{\"type\":\"Integer\",\"value\":" + (before + 7_200_000) + "}");

        awaitRouted("future", record -> assertThat(record.timestamp()).isBetween(before, System.currentTimeMillis()));
    }

    @Test
    void takesTheTimeOfTheContextBrokerForAMissingOrUnreadableTime() throws Exception {
        long before = System.currentTimeMillis();
        send("timeless", "\"n\":{\"type\":\"Number\",\"value\":1}");
        send("noon", "\"Time\":{\"type\":\"Integer\",\"value\":\"noon\"}");

        for (String id : List.of("timeless", "noon")) {
            awaitRouted(id, record -> assertThat(record.timestamp()).isBetween(before, System.currentTimeMillis()));
        }
    }

    @Test
    void readsATimeThatCameAsText() throws Exception {
        send("texted", "\"Time\":{\"type\":\"String\",\"value\":\"" + MILLIS_2023 + "\"}");

        awaitRouted("texted", record -> assertThat(record.timestamp()).isEqualTo(MILLIS_2023));
    }

    @Test
    void routesADomainWithADotToATopicOfItsOwn() throws Exception {
        running.ngsi()
                .append(
                        "{\"id\":\"dotted\",\"type\":\"Probe\",\"Domain\":{\"type\":\"String\",\"value\":\"bad.input\"}}");

        awaitRouted(
                "data._x-bad-2Einput.realtime",
                "dotted",
                record -> assertThat(record.value()).isNotEmpty());
    }

    @Test
    void losesNothingOfOthersNorOfADeviceThatNeverStops() throws Exception {
        LoadPlan flood = new LoadPlan(1, Duration.ofMillis(2), 1000, Duration.ofSeconds(4), "bad", "flood");
        LoadFleet.provision(running.suite().devices(), flood);
        try (LoadFleet device = LoadFleet.start(running.suite().devices(), flood)) {
            for (int i = 0; i < 20; i++) {
                send("beside", "\"n\":{\"type\":\"Number\",\"value\":" + i + "}");
            }
            device.await();
        }

        try (TopicLog domain = running.topic("data.bad.realtime")) {
            Arrivals.await((int) flood.messages(), () -> payloads(domain).size());
            assertThat(payloads(domain)).hasSize((int) flood.messages()).doesNotHaveDuplicates();
            Arrivals.await(20, () -> domain.of("beside").size());
            assertThat(domain.of("beside")).hasSize(20);
        }
    }

    private static List<String> payloads(TopicLog domain) throws UnreadableException {
        List<String> payloads = new ArrayList<>();
        for (ConsumerRecord<byte[], byte[]> record : domain.of("urn:ngsi-ld:Device:flood-00000")) {
            Entity.parse(record.value()).text("Payload").ifPresent(payloads::add);
        }
        return payloads;
    }

    private static byte[] unreadable(String kind) {
        String body = switch (kind) {
            case "no JSON" -> "temperature=21";
            case "no entity" -> "{\"subscriptionId\":\"s\",\"data\":\"none\"}";
            case "ten megabytes" -> "{\"id\":\"big\",\"x\":\"" + "y".repeat(10_000_000) + "\"}";
            case "deeply nested" -> "[".repeat(100_000) + "]".repeat(100_000);
            default -> throw new IllegalArgumentException(kind);
        };
        return body.getBytes(UTF_8);
    }

    private static void send(String id, String attribute) throws Exception {
        assertThat(running.ngsi().append(entity(id, attribute))).isEqualTo(204);
    }

    private static String entity(String id, String attribute) {
        return "{\"id\":\"%s\",\"type\":\"Probe\",\"Domain\":{\"type\":\"String\",\"value\":\"bad\"},%s}"
                .formatted(id, attribute);
    }

    private static String result(String text) {
        return "{\"id\":\"%s\",\"type\":\"Note\",\"text\":{\"type\":\"String\",\"value\":\"%s\"}}"
                .formatted(text.replaceAll("\\W", ""), text);
    }

    private static String thermometer(String id, double reading, String latitude, String longitude) {
        return entity(
                id,
                "\"Temperature\":{\"type\":\"Float\",\"value\":%s},\"Latitude\":{\"type\":\"Float\",\"value\":\"%s\"},"
                                .formatted(reading, latitude)
                        + "\"Longitude\":{\"type\":\"Float\",\"value\":\"%s\"}".formatted(longitude));
    }

    private static void awaitDeadLetter(String reason, String stage) {
        try (TopicLog dead = running.topic("data.raw.dead")) {
            await()
                    .untilAsserted(() -> assertThat(dead.records())
                            .map(TopicLog::headers)
                            .anySatisfy(headers -> assertThat(headers)
                                    .containsEntry(DeadLetter.REASON, reason)
                                    .containsEntry(DeadLetter.STAGE, stage)));
        }
    }

    private static void awaitRouted(String id, ThrowingConsumer<ConsumerRecord<byte[], byte[]>> expected) {
        awaitRouted("data.bad.realtime", id, expected);
    }

    private static void awaitRouted(
            String topic, String id, ThrowingConsumer<ConsumerRecord<byte[], byte[]>> expected) {
        await().untilAsserted(() -> {
            try (TopicLog log = running.topic(topic)) {
                assertThat(log.of(id)).isNotEmpty().first().satisfies(expected);
            }
        });
    }
}
