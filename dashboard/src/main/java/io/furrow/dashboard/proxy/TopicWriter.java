package io.furrow.dashboard.proxy;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.control.AdminCommands;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.TopicRules;

/** Writes messages of sockets to topics, in the name of their user. */
final class TopicWriter implements AutoCloseable {
    private static final String TIMEOUT_MILLIS = "10000";

    private final TopicRules rules;
    private final KafkaProducer<byte[], byte[]> producer;

    TopicWriter(Properties client, TopicRules rules) {
        this.rules = rules;
        Properties settings = new Properties();
        client.stringPropertyNames().forEach(name -> settings.setProperty(name, client.getProperty(name)));
        settings.setProperty("max.block.ms", TIMEOUT_MILLIS);
        settings.setProperty("request.timeout.ms", TIMEOUT_MILLIS);
        settings.setProperty("delivery.timeout.ms", TIMEOUT_MILLIS);
        settings.setProperty("linger.ms", "0");
        producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
    }

    /**
     * Writes a message.
     *
     * @return its position, once Kafka has acknowledged it
     * @throws Problem if the topic may not be written, the user's role does not allow the command, or the message is
     *     not a JSON object
     */
    CompletionStage<RecordMetadata> write(String topic, User user, String message) {
        if (!rules.mayWrite(topic)) {
            throw new Problem(
                    403,
                    "topic-not-allowed",
                    "topic '%s' may not be written; --writable-topics lists the writable topics".formatted(topic));
        }
        check(user, Role.OPERATOR);
        ObjectNode json = read(message);
        if (AdminCommands.contains(topic, json.path("command").asText())) {
            check(user, Role.ADMIN);
        }
        json.put("user", user.name()); // a client cannot act as another user
        JsonNode id = json.path("requestId");
        byte[] key = id.isTextual() ? id.asText().getBytes(StandardCharsets.UTF_8) : null;
        CompletableFuture<RecordMetadata> written = new CompletableFuture<>();
        try {
            producer.send(new ProducerRecord<>(topic, key, NgsiJson.write(json)), (at, failure) -> {
                if (failure == null) {
                    written.complete(at);
                } else {
                    written.completeExceptionally(notWritten(topic, failure));
                }
            });
        } catch (KafkaException e) {
            written.completeExceptionally(notWritten(topic, e));
        }
        return written;
    }

    private static void check(User user, Role minimum) {
        if (!user.role().includes(minimum)) {
            throw new Problem(
                    403,
                    "forbidden",
                    "this needs the role %s, and '%s' is %s"
                            .formatted(minimum.code(), user.name(), user.role().code()));
        }
    }

    private static ObjectNode read(String message) {
        try {
            if (NgsiJson.read(message.getBytes(StandardCharsets.UTF_8)) instanceof ObjectNode object) {
                return object;
            }
        } catch (UnreadableException e) {
            throw new Problem(400, "not-json", "the message is not JSON: " + e.getMessage());
        }
        throw new Problem(400, "not-json", "the message is not a JSON object");
    }

    private static Problem notWritten(String topic, Exception failure) {
        return new Problem(
                503,
                "not-written",
                "Kafka did not acknowledge the message for topic '%s' within 10 s (%s); it may still be written, so retry with the same requestId"
                        .formatted(topic, FailureText.of(failure)));
    }

    @Override
    public void close() {
        producer.close(Duration.ofSeconds(2));
    }
}
