package io.furrow.dashboard;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.net.http.WebSocketHandshakeException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletionException;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.common.utils.Utils;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtendWith;
import org.junit.jupiter.api.extension.ExtensionContext;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/**
 * Starts a dashboard in front of a real Kafka and a real REST API of the control plane, which all test classes share.
 */
@ExtendWith(DashboardFixture.SharedServers.class)
abstract class DashboardFixture {
    static final String VERA = "vera-reads-only-0001";
    static final String OLGA = "olga-commands-000001";
    static final String ANNA = "anna-rules-the-farm1";
    static final String TOPIC = "data.farm.realtime.weeding";
    static final String REPLAY = "data.m.replay.0a1b2c3d";

    static EmbeddedKafka kafka;
    static RestApi api;
    static KafkaProducer<String, byte[]> producer;

    final HttpClient http = HttpClient.newHttpClient();

    @AutoClose
    Dashboard dashboard;

    /** Keeps Kafka and the REST API running from the first test class of a JVM to the last. */
    static final class SharedServers implements BeforeAllCallback {
        private static final ExtensionContext.Namespace NAMESPACE =
                ExtensionContext.Namespace.create(SharedServers.class);

        @Override
        public void beforeAll(ExtensionContext context) {
            context.getRoot()
                    .getStore(NAMESPACE)
                    .getOrComputeIfAbsent("servers", key -> startServers(), AutoCloseable.class);
        }
    }

    private static AutoCloseable startServers() {
        try {
            Path directory = Files.createTempDirectory("dashboard");
            kafka = EmbeddedKafka.start(
                    directory.resolve("kafka"),
                    0,
                    Map.of(
                            "authorizer.class.name", "org.apache.kafka.metadata.authorizer.StandardAuthorizer",
                            "allow.everyone.if.no.acl.found", "true"));
            Path tokens = directory.resolve("tokens");
            Files.writeString(tokens, "vera %s viewer%nolga %s operator%nanna %s admin%n".formatted(VERA, OLGA, ANNA));
            api = RestApi.start(
                    ControlSettings.of(kafka.client()),
                    RestSettings.on(0).withTokens(tokens),
                    new Readiness(Clock.systemUTC()));
            kafka.createTopics(topics(TOPIC, "data.farm.realtime", REPLAY));
            kafka.createTopics(List.of(new NewTopic(Topics.LATEST, Optional.of(2), Optional.empty())));
            producer = new KafkaProducer<>(kafka.producerSettings(), new StringSerializer(), new ByteArraySerializer());
            await().until(api::isReady);
            return () -> {
                producer.close();
                api.close();
                kafka.close();
                Utils.delete(directory.toFile());
            };
        } catch (Exception e) {
            throw new IllegalStateException("Kafka and the REST API did not start", e);
        }
    }

    /** Topics of one partition. */
    static List<NewTopic> topics(String... names) {
        return List.of(names).stream()
                .map(name -> new NewTopic(name, Optional.of(1), Optional.empty()))
                .toList();
    }

    @BeforeEach
    void start() throws Exception {
        dashboard = Dashboard.start(settings());
    }

    static DashboardSettings settings() {
        return DashboardSettings.of(0, kafka.client(), api.uri());
    }

    void restart(DashboardSettings other) throws Exception {
        dashboard.close();
        dashboard = Dashboard.start(other);
    }

    HttpResponse<String> get(String path, String token, String... headers) throws Exception {
        HttpRequest.Builder request = HttpRequest.newBuilder(dashboard.uri().resolve(path));
        if (token != null) {
            request.header("Authorization", "Bearer " + token);
        }
        for (int i = 0; i < headers.length; i += 2) {
            request.header(headers[i], headers[i + 1]);
        }
        return http.send(request.build(), HttpResponse.BodyHandlers.ofString());
    }

    static JsonNode json(HttpResponse<String> answer) throws Exception {
        return NgsiJson.read(answer.body().getBytes(UTF_8));
    }

    String error(String path, String token, String... headers) throws Exception {
        HttpResponse<String> answer = get(path, token, headers);
        return answer.statusCode() + " " + json(answer).path("error").asText();
    }

    URI socket(String topicAndQuery, String token) throws Exception {
        HttpResponse<String> answer = get("/api/register/" + topicAndQuery, token);
        assertThat(answer.statusCode()).as(answer.body()).isEqualTo(200);
        return URI.create(dashboard.uri().toString().replace("http", "ws")
                + json(answer).path("socket").asText());
    }

    /** Opens a socket and waits until it receives new records. */
    SocketClient open(String topicAndQuery) throws Exception {
        return open(topicAndQuery, true);
    }

    SocketClient open(String topicAndQuery, boolean reads) throws Exception {
        SocketClient client = SocketClient.open(http, socket(topicAndQuery, OLGA), reads);
        int before = client.frames().size();
        String topic = topicAndQuery.replaceAll("\\?.*", "");
        await().until(() -> {
            send(topic, "probe", "{\"probe\":true}");
            return client.frames().size() > before;
        });
        return client;
    }

    static void send(String topic, String key, String value) throws Exception {
        producer.send(new ProducerRecord<>(topic, key, value == null ? null : value.getBytes(UTF_8)))
                .get();
    }

    static List<JsonNode> without(List<JsonNode> records, String key) {
        return records.stream()
                .filter(record -> !record.path("key").asText().equals(key))
                .toList();
    }

    static StreamLimits limits(int waiting, int streams) {
        StreamLimits defaults = StreamLimits.DEFAULT;
        return new StreamLimits(
                streams,
                streams,
                3,
                defaults.ticketLife(),
                waiting,
                defaults.waitingBytes(),
                10_000,
                defaults.messageBytes(),
                5,
                defaults.primeRecords());
    }

    static int status(Throwable failure) {
        assertThat(failure).isInstanceOf(CompletionException.class);
        return ((WebSocketHandshakeException) failure.getCause()).getResponse().statusCode();
    }

    static long ends(String topic) {
        try (var consumer = new KafkaConsumer<>(kafka.client(), new StringDeserializer(), new StringDeserializer())) {
            List<TopicPartition> all = consumer.partitionsFor(topic).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            return consumer.endOffsets(all).values().stream()
                    .mapToLong(Long::longValue)
                    .sum();
        }
    }

    double metric(String name) throws Exception {
        return get("/metrics", null)
                .body()
                .lines()
                .filter(line -> line.startsWith("furrow_dashboard_" + name + " "))
                .mapToDouble(line -> Double.parseDouble(line.substring(line.lastIndexOf(' '))))
                .findFirst()
                .orElse(-1);
    }
}
