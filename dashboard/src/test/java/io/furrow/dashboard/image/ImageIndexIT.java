package io.furrow.dashboard.image;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.stream.IntStream;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.assertj.core.api.Condition;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.dashboard.http.Problem;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class ImageIndexIT {
    private static final String FIRST = "a".repeat(64);
    private static final String SECOND = "b".repeat(64);
    private static final String THIRD = "c".repeat(64);

    @Tag("full")
    @Test
    void readsTheNewestRecordsOfATopicThatIsCreatedLater(@TempDir Path directory) throws Exception {
        try (EmbeddedKafka kafka = EmbeddedKafka.start(directory);
                KafkaProducer<String, byte[]> producer = new KafkaProducer<>(
                        kafka.producerSettings(), new StringSerializer(), new ByteArraySerializer());
                ImageIndex early = new ImageIndex(kafka.client());
                ImageIndex late = new ImageIndex(kafka.client(), 2)) {
            early.start();
            assertThatThrownBy(() -> early.find(FIRST)).isInstanceOf(Problem.class);
            kafka.createTopics(List.of(new NewTopic(Topics.IMAGES, Optional.of(1), Optional.empty())));
            for (String sha256 : new String[] {FIRST, SECOND, SECOND}) {
                send(producer, sha256);
            }
            await().ignoreExceptionsInstanceOf(Problem.class)
                    .until(() -> early.find(FIRST).isPresent());
            late.start();
            await().ignoreExceptionsInstanceOf(Problem.class)
                    .until(() -> late.find(SECOND).isPresent());
            assertThat(late.find(FIRST)).as("before the newest two").isEmpty();
            send(producer, THIRD);
            await().until(() -> late.find(THIRD).isPresent());
            assertThat(IntStream.range(0, 20)
                            .mapToObj(i -> CompletableFuture.supplyAsync(
                                    () -> late.find("d".repeat(64)), task -> new Thread(task).start()))
                            .toList())
                    .as("those for whom there is no place to wait can try again")
                    .haveAtLeastOne(new Condition<>(ImageIndexIT::fails, "503"))
                    .haveAtLeastOne(new Condition<>(find -> !fails(find), "404"));
        }
    }

    private static boolean fails(CompletableFuture<?> find) {
        return find.handle((found, failure) -> failure != null).join();
    }

    @Test
    void answersThatItIsLoadingWhileKafkaIsUnavailable() {
        Properties client = new Properties();
        client.put("bootstrap.servers", "127.0.0.1:" + FreePort.orFree(0));
        try (ImageIndex index = new ImageIndex(client)) {
            index.start();
            assertThatThrownBy(() -> index.find(FIRST))
                    .isInstanceOf(Problem.class)
                    .hasMessageContaining("try again")
                    .extracting(problem -> ((Problem) problem).status())
                    .isEqualTo(503);
            assertThat(index.find("no SHA-256")).isEmpty();
        }
    }

    private static void send(KafkaProducer<String, byte[]> producer, String sha256) throws Exception {
        String record = "{\"sha256\":\"%s\",\"contentType\":\"image/png\",\"url\":\"file:///x.png\"}".formatted(sha256);
        producer.send(new ProducerRecord<>(Topics.IMAGES, "camera", record.getBytes(UTF_8)))
                .get();
    }
}
