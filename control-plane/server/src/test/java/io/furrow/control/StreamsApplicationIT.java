package io.furrow.control;

import java.nio.file.Path;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.atomic.AtomicInteger;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.kstream.Consumed;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class StreamsApplicationIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);

    private final AtomicInteger failures = new AtomicInteger();
    private final AtomicInteger handled = new AtomicInteger();

    /** Survives failures that bypass the exception handlers: an error of the JVM, then a client that cannot be created at first. */
    @Test
    void replacesAFailedClient(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"))) {
            Properties client = kafka.client();
            client.setProperty("state.dir", directory.resolve("state").toString());
            ControlSettings settings = ControlSettings.of(client);
            ServiceTopics.prepare(settings);
            try (StreamsApplication application =
                            new StreamsApplication("application", this::topology, settings.streams());
                    KafkaProducer<String, byte[]> producer = KafkaClients.producer(client)) {
                application.startClient();
                await().atMost(TIMEOUT).until(application::isHealthy);
                producer.send(new ProducerRecord<>(Topics.DOMAINS, "north", new byte[1]));

                await().atMost(TIMEOUT)
                        .untilAtomic(handled, count -> assertThat(count).isPositive());
                await().atMost(TIMEOUT).until(application::isHealthy);
                assertThat(failures).hasValue(2);
                ComponentStatus status = application.status();
                assertThat(status.state()).isEqualTo(ComponentStatus.State.UP);
                assertThat(status.lastSuccess()).isNotNull();
            }
        }
    }

    private Topology topology() {
        if (failures.get() == 1) {
            failures.incrementAndGet();
            throw new KafkaException("as if no address of Kafka resolved");
        }
        StreamsBuilder builder = new StreamsBuilder();
        builder.stream(Topics.DOMAINS, Consumed.with(Serdes.String(), Serdes.ByteArray()))
                .foreach((key, value) -> {
                    if (failures.get() == 0) {
                        failures.incrementAndGet();
                        throw new AssertionError("as if there was no memory left");
                    }
                    handled.incrementAndGet();
                });
        return builder.build();
    }
}
