package io.furrow.dashboard;

import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.URI;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.RecordsToDelete;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Tests the reports of the dashboard on topics, Kafka, the control plane and itself. */
class DashboardStatusIT extends DashboardFixture {
    @Test
    void returnsTheHistoryOfATopic() throws Exception {
        long before = System.currentTimeMillis();
        send("data.farm.realtime", "history", "{\"n\":7}");

        JsonNode answer = json(get("/api/history/data.farm.realtime?from=" + before, VERA));
        assertThat(answer.path("since").asLong()).isEqualTo(before);
        assertThat(answer.path("records"))
                .anySatisfy(record -> assertThat(record.at("/value/n").asInt()).isEqualTo(7));

        String path = "/api/history/data.farm.realtime";
        assertThat(error(path + "?from=0", null)).isEqualTo("401 unauthorized");
        assertThat(error(path, VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?from=noon", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?from=5&to=4", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?from=0&limit=5001", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?from=0&newest=a.b", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error("/api/history/data.raw.dead?from=0", VERA)).isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/history/data.nothing?from=0", VERA)).isEqualTo("404 unknown-topic");
    }

    @Tag("full")
    @Test
    void countsTheRecordsOfATopicPerBucket() throws Exception {
        String topic = "data.canary.realtime";
        long begin = 1_700_000_000_000L;
        for (long after : new long[] {0, 1, 999, 2_500, 2_600, 9_000}) {
            producer.send(new ProducerRecord<>(topic, null, begin + after, "key" + after, "{}".getBytes(UTF_8)))
                    .get();
        }
        String path = "/api/density/" + topic;

        JsonNode answer = json(get(path + "?width=1000&from=" + (begin + 300) + "&to=" + (begin + 4_000), VERA));
        assertThat(answer.path("from").asLong()).as(answer.toString()).isEqualTo(begin);
        assertThat(answer.path("counts").toString()).isEqualTo("[3,0,2,0]");
        // again, partly from the cache, and up to the end of the topic
        answer = json(get(path + "?width=1000&from=" + begin + "&to=" + (begin + 10_000), VERA));
        assertThat(answer.path("counts").toString()).isEqualTo("[3,0,2,0,0,0,0,0,0,1]");

        assertThat(error(path + "?width=1000&from=0&to=1000", null)).isEqualTo("401 unauthorized");
        assertThat(error(path + "?from=0&to=1", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?width=99&from=0&to=1", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?width=1000&from=0&to=400001", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(get(path + "?width=1000&from=0&to=400001", VERA).body())
                .contains("there are at most 400 buckets: 'to' must be at most 400000");
        assertThat(error("/api/density/data.raw.dead?width=1000&from=0&to=1", VERA))
                .isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/density/data.nothing?width=1000&from=0&to=1", VERA))
                .isEqualTo("404 unknown-topic");
    }

    @Tag("full")
    @Test
    void reportsLagAndRetainedDeadLetters() throws Exception {
        String topic = "counted";
        String dead = "counted.dead";
        try (Admin admin = Admin.create(kafka.client())) {
            kafka.createTopics(topics(topic, dead));
            for (int i = 0; i < 5; i++) {
                producer.send(new ProducerRecord<>(topic, "k", new byte[] {1})).get();
                producer.send(new ProducerRecord<>(dead, "k", new byte[] {1})).get();
            }
            admin.deleteRecords(Map.of(new TopicPartition(dead, 0), RecordsToDelete.beforeOffset(3)))
                    .all()
                    .get();
            admin.alterConsumerGroupOffsets("counting", Map.of(new TopicPartition(topic, 0), new OffsetAndMetadata(1)))
                    .all()
                    .get();
        }

        JsonNode platform = json(get("/api/platform", VERA));

        assertThat(platform.at("/kafka/state").asText()).isEqualTo("up");
        assertThat(find(platform.path("deadLetters"), "topic", dead)
                        .path("records")
                        .asInt())
                .isEqualTo(2);
        assertThat(find(platform.path("groups"), "group", "counting")
                        .at("/topics/" + topic)
                        .asInt())
                .isEqualTo(4);
        assertThat(error("/api/platform", null)).isEqualTo("401 unauthorized");
    }

    private static JsonNode find(JsonNode list, String member, String name) {
        for (JsonNode each : list) {
            if (name.equals(each.path(member).asText())) {
                return each;
            }
        }
        return list.path("missing");
    }

    @Tag("full")
    @Test
    void reportsHealthReadinessAndMetrics() throws Exception {
        await().until(() -> get("/ready", null).statusCode() == 200);
        assertThat(json(get("/health", null)).path("status").asText()).isEqualTo("up");
        assertThat(json(get("/ready", null)).at("/parts/kafka/state").asText()).isEqualTo("up");
        assertThat(json(get("/ready", null)).at("/parts/controlPlane/state").asText())
                .isEqualTo("up");

        SocketClient client = open(TOPIC + "?format=record");
        SocketClient writer = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER + "?format=record", OLGA));
        writer.send("{\"type\":\"request\"}");
        writer.send("[]");
        error("/api/register/" + TOPIC, null);
        error("/api/register/data.raw.dead", OLGA);
        await().until(() -> metric("refused_total{reason=\"not-json\"}") == 1);
        await().until(() -> metric("messages_written_total") == 1);
        assertThat(metric("streams{kind=\"socket\"}")).isEqualTo(2);
        assertThat(metric("topics")).isEqualTo(2);
        assertThat(metric("records_read_total")).isPositive();
        assertThat(metric("records_sent_total"))
                .isGreaterThanOrEqualTo(client.records().size());
        assertThat(metric("refused_total{reason=\"unauthorized\"}")).isEqualTo(1);
        error("/api/platform", null);
        assertThat(metric("refused_total{reason=\"unauthorized\"}")).isEqualTo(2);
        assertThat(metric("refused_total{reason=\"topic-not-allowed\"}")).isEqualTo(1);
        assertThat(metric("streams_closed_total{reason=\"client\"}")).isZero();
        client.close();
        await().until(() -> metric("streams_closed_total{reason=\"client\"}") == 1);
        assertThat(get("/metrics", null).body()).doesNotContain(TOPIC).doesNotContain("olga");
    }

    @Tag("full")
    @Test
    void isNotReadyWithoutTheControlPlane() throws Exception {
        restart(DashboardSettings.of(0, kafka.client(), URI.create("http://127.0.0.1:1")));

        await().until(() ->
                json(get("/ready", null)).at("/parts/kafka/state").asText().equals("up"));
        HttpResponse<String> answer = get("/ready", null);
        assertThat(answer.statusCode()).isEqualTo(503);
        assertThat(json(answer).path("status").asText()).isEqualTo("not-ready");
        assertThat(json(answer).at("/parts/controlPlane/detail").asText()).isEqualTo("connection refused");
        assertThat(get("/health", null).statusCode()).isEqualTo(200);
    }

    /** More requests than the server has threads wait for a control plane that does not respond. */
    @Tag("full")
    @Test
    void servesHealthAndThePageWhileTheControlPlaneDoesNotRespond() throws Exception {
        try (ServerSocket silent = new ServerSocket(0, 500, InetAddress.getLoopbackAddress())) {
            restart(DashboardSettings.of(0, kafka.client(), URI.create("http://127.0.0.1:" + silent.getLocalPort())));
            await().until(() -> {
                List<CompletableFuture<HttpResponse<String>>> waiting = IntStream.range(0, 150)
                        .mapToObj(i -> http.sendAsync(
                                HttpRequest.newBuilder(dashboard.uri().resolve("/api/topics"))
                                        .header("Authorization", "Bearer token-of-nobody-" + i)
                                        .build(),
                                HttpResponse.BodyHandlers.ofString()))
                        .toList();
                int health = get("/health", null).statusCode();
                int page = get("/app.js", null).statusCode();
                int config = get("/config.json", null).statusCode();
                boolean blocked = waiting.stream().noneMatch(CompletableFuture::isDone);
                waiting.forEach(each -> each.cancel(true));
                return blocked && health == 200 && page == 200 && config == 200;
            });
        }
    }
}
