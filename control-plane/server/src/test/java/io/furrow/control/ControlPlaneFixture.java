package io.furrow.control;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Callable;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerConfig;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Sends requests to control planes on an embedded Kafka and reads their answers. */
abstract class ControlPlaneFixture {
    static final Duration TIMEOUT = Duration.ofSeconds(90);

    @TempDir
    Path directory;

    EmbeddedKafka kafka;

    @BeforeEach
    void startKafka() {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
    }

    @AfterEach
    void stopKafka() {
        kafka.close();
    }

    static void create(KafkaProducer<String, byte[]> producer, int number) {
        DomainCommand command = new DomainCommand.Create("d-" + number, DomainDetails.NONE);
        producer.send(new ProducerRecord<>(Topics.DOMAIN_MANAGER, Requests.write("r-" + number, command)));
    }

    /**
     * With one request at a time: if the first is retried, a broker that does not know the producer yet would accept the
     * second, and never the first.
     */
    KafkaProducer<String, byte[]> producer() {
        Properties settings = kafka.client();
        settings.setProperty(ProducerConfig.MAX_IN_FLIGHT_REQUESTS_PER_CONNECTION, "1");
        return KafkaClients.producer(settings);
    }

    List<CommandResult> answers(String topic) throws Exception {
        List<CommandResult> answers = new ArrayList<>();
        for (ConsumerRecord<String, byte[]> record : records(topic)) {
            if (new String(record.value(), UTF_8).contains("\"type\":\"response\"")) {
                answers.add(CommandResult.read(record.value()));
            }
        }
        return answers;
    }

    List<ConsumerRecord<String, byte[]>> records(String topic) {
        return new TopicContent(kafka.client(), topic).records();
    }

    static void await(Callable<Boolean> condition) {
        Awaitility.await().atMost(TIMEOUT).until(condition);
    }
}
