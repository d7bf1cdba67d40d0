package io.furrow.connect.sink;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicInteger;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.connect.sink.FakeContextBroker.Reply;
import io.furrow.connect.sink.FakeContextBroker.Update;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class NgsiSinkIT {
    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    @AutoClose
    private final FakeContextBroker broker = new FakeContextBroker();

    @BeforeAll
    static void startWorker() {
        rig = ConnectRig.start(directory);
    }

    @Test
    void setsTheOneRefusedOfTwentyAsideAndWritesTheOthers() {
        broker.behaviour = update -> update.body().toString().contains("\"e7\"")
                ? new Reply(400, "{\"error\":\"BadRequest\",\"description\":\"forbidden characters\"}")
                : Reply.WRITTEN;
        produce("isolated", 20);

        write("isolated");

        await().until(() -> broker.entities.size() == 19);
        try (TopicReader dead = new TopicReader(rig.bootstrapServers(), "isolated.dead")) {
            assertThat(dead.atLeast(1))
                    .singleElement()
                    .satisfies(letter -> assertThat(letter.key()).isEqualTo("e7"))
                    .extracting(letter -> new String(
                            letter.headers()
                                    .lastHeader("__connect.errors.exception.message")
                                    .value(),
                            UTF_8))
                    .asString()
                    .contains("forbidden characters");
        }
        assertThat(broker.requests).allSatisfy(update -> {
            assertThat(update.service()).isEqualTo("agri");
            assertThat(update.servicePath()).isEqualTo("/plot1");
        });
    }

    @Tag("full")
    @Test
    void triesAgainWhenTheContextBrokerIsOverloaded() {
        AtomicInteger refusals = new AtomicInteger(3);
        List<Long> tries = new CopyOnWriteArrayList<>();
        broker.behaviour = update -> {
            tries.add(System.nanoTime());
            int left = refusals.getAndDecrement();
            return left > 1
                    ? new Reply(503, "overloaded")
                    : left == 1 ? new Reply(429, "not so fast", "2") : Reply.WRITTEN;
        };
        produce("retried", 5);

        write("retried");

        await().until(() -> broker.entities.size() == 5);
        assertThat(Duration.ofNanos(tries.get(3) - tries.get(2)))
                .as("what Retry-After asked for")
                .isGreaterThan(Duration.ofMillis(1_900));
        assertThat(broker.requests)
                .hasSizeGreaterThan(3)
                .extracting(Update::path)
                .containsOnly("/v2/op/update");
        assertThat(rig.get("/connectors/ngsi-sink/status")
                        .path("tasks")
                        .path(0)
                        .path("state")
                        .asText())
                .isEqualTo("RUNNING");
    }

    private void write(String topic) {
        rig.create(
                "ngsi-sink",
                Map.of(
                        "topics",
                        topic,
                        "context.broker.url",
                        broker.url().toString(),
                        "errors.deadletterqueue.topic.name",
                        topic + ".dead",
                        "retry.backoff.ms",
                        "100",
                        "consumer.override.metadata.max.age.ms",
                        "500"));
    }

    private static void produce(String topic, int count) {
        try (KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                Map.of("bootstrap.servers", rig.bootstrapServers(), "max.in.flight.requests.per.connection", 1),
                new StringSerializer(),
                new ByteArraySerializer())) {
            for (int i = 0; i < count; i++) {
                byte[] entity =
                        Entity.builder("e" + i, "T").integer("x", i).build().toBytes();
                ProducerRecord<String, byte[]> record = new ProducerRecord<>(topic, "e" + i, entity);
                record.headers().add("fiware-service", "agri".getBytes(UTF_8));
                record.headers().add("fiware-servicepath", "/plot1".getBytes(UTF_8));
                producer.send(record);
            }
        }
    }
}
