package io.furrow.suite;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.StringSerializer;
import org.assertj.core.api.ThrowingConsumer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.load.LoadFleet;
import io.furrow.simulators.load.LoadPlan;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Faulty inputs and their outcomes; after each of them a valid event is still processed. */
@Tag("full")
class BadInputIT {
    @AutoClose
    private static RunningSuite running;

    private static int validEvents;

    @BeforeAll
    static void start() throws Exception {
        running = RunningSuite.start(null);
    }

    @AfterEach
    void processesAValidEvent() throws Exception {
        String id = "good-" + validEvents++;
        assertThat(running.ngsi().append(entity(id, "\"n\":{\"type\":\"Number\",\"value\":1}")))
                .isEqualTo(204);
        awaitRouted(id, record -> assertThat(record.value()).isNotEmpty());
    }

    @Test
    void writesAResultThatTheContextBrokerRejectsToTheDeadLetters() throws Exception {
        try (KafkaProducer<String, String> producer = new KafkaProducer<>(
                running.suite().kafka().clientProperties(), new StringSerializer(), new StringSerializer())) {
            for (String text : List.of("(refused)", "accepted")) {
                ProducerRecord<String, String> result = new ProducerRecord<>("data.context", 0, text, result(text));
                result.headers().add(HeaderNames.SERVICE, "farm".getBytes(UTF_8));
                producer.send(result).get();
            }
        }

        await().untilAsserted(
                        () -> assertThat(running.ngsi().entities("id=accepted")).hasSize(1));
        try (TopicLog dead = running.topic("ngsi-sink.dead")) {
            await().untilAsserted(() -> assertThat(dead.of("(refused)")).hasSize(1));
        }
    }

    @ParameterizedTest
    @CsvSource({"NaN, -3.483", "-3.483, 40.3134", "0, 0", "95, -3.483"})
    void routesADeviceWithoutAUsablePositionButExcludesItFromTheAverage(String latitude, String longitude)
            throws Exception {
        String id = "lost-" + latitude;
        String good = "found-" + latitude;

        assertThat(running.ngsi().append(thermometer(id, 99, latitude, longitude)))
                .isEqualTo(204);
        awaitRouted(
                id,
                record -> assertThat(Entity.parse(record.value()).number("Temperature"))
                        .contains(99.0));

        // Both report until a window with the valid reading has closed; the other reading is never part of it.
        await().pollInterval(Duration.ofMillis(300)).untilAsserted(() -> {
            double reading = 20 + System.nanoTime() % 1000 / 1e6;
            running.ngsi().append(thermometer(id, 99 + reading / 1000, latitude, longitude));
            running.ngsi().append(thermometer(good, reading, "40.3134", "-3.483"));
            assertThat(running.ngsi()
                            .entity("Analytics:FieldTemperature:field-1")
                            .at("/plainMean/value")
                            .asDouble())
                    .isBetween(19.9, 20.2);
        });
    }

    @Test
    void losesNoEventsWhileADeviceFloodsTheTopic() throws Exception {
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

    private static void awaitRouted(String id, ThrowingConsumer<ConsumerRecord<byte[], byte[]>> expected) {
        await().untilAsserted(() -> {
            try (TopicLog log = running.topic("data.bad.realtime")) {
                assertThat(log.of(id)).isNotEmpty().first().satisfies(expected);
            }
        });
    }
}
