package io.furrow.kafka;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assertions.assertTimeout;

@Tag("full")
class CommittedReaderIT {
    private static final String TOPIC = "topic";

    @Test
    void closesWithoutWaitingForAPendingFetch(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"));
                KafkaProducer<String, byte[]> producer = KafkaClients.producer(kafka.client())) {
            kafka.createTopics(List.of(new NewTopic(TOPIC, 1, (short) 1)));
            producer.send(new ProducerRecord<>(TOPIC, "key", new byte[1])).get();
            Properties client = kafka.client();
            client.put("fetch.max.wait.ms", "20000");

            assertTimeout(Duration.ofSeconds(10), () -> {
                try (CommittedReader<String> reader = CommittedReader.open(client, TOPIC)) {
                    reader.readToEnd(record -> assertThat(record.key()).isEqualTo("key"));
                }
            });
        }
    }
}
