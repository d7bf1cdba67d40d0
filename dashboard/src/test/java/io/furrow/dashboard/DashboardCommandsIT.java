package io.furrow.dashboard;

import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.catchThrowable;
import static org.awaitility.Awaitility.await;

/** Commands that users write to topics or send to the control plane, in their own name. */
class DashboardCommandsIT extends DashboardFixture {
    @Test
    void forwardsToTheControlPlaneWithTheTokenOfTheUser() throws Exception {
        assertThat(json(get("/api/me", VERA)))
                .isEqualTo(NgsiJson.read("{\"user\":\"vera\",\"role\":\"viewer\"}".getBytes(UTF_8)));
        assertThat(error("/api/me", null)).isEqualTo("401 unauthorized");
        assertThat(get("/api/me", OLGA, "Origin", dashboard.uri().toString()).statusCode())
                .isEqualTo(200);
        assertThat(error("/api/me", OLGA, "Origin", "https://evil.example")).isEqualTo("403 foreign-origin");
        assertThat(get("/api/missions?domain=none", VERA).body()).isEqualTo("[]");
        HttpResponse<String> posted = http.send(
                HttpRequest.newBuilder(dashboard.uri().resolve("/api/domains"))
                        .header("Authorization", "Bearer " + VERA)
                        .header("Content-Type", "application/json")
                        .POST(HttpRequest.BodyPublishers.ofString("{\"domain\":\"x\"}"))
                        .build(),
                HttpResponse.BodyHandlers.ofString());
        assertThat(posted.statusCode() + " " + json(posted).path("error").asText())
                .isEqualTo("403 forbidden");
        assertThat(get("/api/me", VERA).headers().firstValue("Content-Security-Policy"))
                .isPresent();
        for (String file : List.of("/api", "/api/page/page.js", "/openapi.json")) { // without a token
            assertThat(get(file, null).statusCode()).as(file).isIn(200, 302);
        }
    }

    @Test
    void rejectsCommandsOfAViewerWithoutForwardingThem() throws Exception {
        List<String> managers =
                List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER);
        long before = managers.stream().mapToLong(DashboardFixture::ends).sum();
        long audited = ends(Topics.AUDIT);
        for (String command : List.of(
                "POST /api/domains",
                "PATCH /api/domains/farm",
                "POST /api/missions",
                "POST /api/missions/weeding/start",
                "DELETE /api/missions/weeding",
                "POST /api/devices/urn:ngsi-ld:Robot:1/commands",
                "POST /api/devices/urn:ngsi-ld:Robot:M%25C3%25BCller/commands",
                "POST /api/replays",
                "POST /api/alarms/mute",
                "POST /api/fields")) {
            HttpResponse<String> answer = command(command, VERA);
            assertThat(answer.statusCode()).as(command).isEqualTo(403);
            assertThat(json(answer).path("error").asText()).as(command).isEqualTo("forbidden");
            assertThat(json(answer).path("reason").asText())
                    .as(command)
                    .isEqualTo("this needs the role operator, and 'vera' is viewer");
        }
        HttpResponse<String> deleted = command("DELETE /api/domains/farm", OLGA);
        assertThat(json(deleted).path("reason").asText())
                .isEqualTo("this needs the role admin, and 'olga' is operator");

        // an operator's command is written after the rejected ones, and is the only one written
        CompletableFuture<HttpResponse<String>> accepted =
                http.sendAsync(commandRequest("POST /api/domains", OLGA), HttpResponse.BodyHandlers.ofString());
        await().until(() -> managers.stream().mapToLong(DashboardFixture::ends).sum() > before);
        assertThat(managers.stream().mapToLong(DashboardFixture::ends).sum()).isEqualTo(before + 1);
        assertThat(last(Topics.DOMAIN_MANAGER).value()).contains("\"olga\"").doesNotContain("vera");
        assertThat(ends(Topics.AUDIT)).isEqualTo(audited);
        accepted.cancel(true); // no manager runs here
    }

    private HttpRequest commandRequest(String command, String token) {
        String[] words = command.split(" ");
        return HttpRequest.newBuilder(dashboard.uri().resolve(words[1]))
                .header("Authorization", "Bearer " + token)
                .header("Content-Type", "application/json")
                .method(words[0], HttpRequest.BodyPublishers.ofString("{\"domain\":\"x\"}"))
                .build();
    }

    private HttpResponse<String> command(String command, String token) throws Exception {
        return http.send(commandRequest(command, token), HttpResponse.BodyHandlers.ofString());
    }

    @Test
    void writesMessagesOfAnOperatorInTheirOwnName() throws Exception {
        SocketClient client = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER + "?format=record", OLGA));
        client.send("{\"type\":\"request\",\"domain\":\"north\",\"requestId\":\"r-1\",\"user\":\"somebody\"}");

        await().until(() -> client.frames().stream().anyMatch(frame -> frame.startsWith("{\"written\"")));
        ConsumerRecord<String, String> written = last(Topics.DOMAIN_MANAGER);
        assertThat(written.key()).isEqualTo("r-1");
        assertThat(NgsiJson.read(written.value().getBytes(UTF_8)).path("user").asText())
                .isEqualTo("olga");
    }

    @Test
    void writesForAdminsAloneTheCommandsThatTheRestApiReservesForThem() throws Exception {
        SocketClient olga = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER, OLGA));
        SocketClient missions = SocketClient.open(http, socket(Topics.MISSION_MANAGER, OLGA));
        SocketClient anna = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER + "?format=record", ANNA));
        String delete = "{\"type\":\"request\",\"command\":\"delete\",\"domain\":\"farm\",\"force\":true}";
        long before = ends(Topics.DOMAIN_MANAGER);

        olga.send(delete);
        missions.send("{\"type\":\"request\",\"command\":\"delete-template\",\"template\":\"hoeing\"}");
        missions.send("{\"type\":\"request\",\"command\":\"rotate-credentials\",\"device\":\"urn:x\"}");

        await().until(() -> olga.frames().size() == 1 && missions.frames().size() == 2);
        assertThat(olga.frames()).allMatch(frame -> frame.contains("needs the role admin, and 'olga' is operator"));
        assertThat(missions.frames()).allMatch(frame -> frame.contains("needs the role admin"));
        assertThat(ends(Topics.MISSION_MANAGER)).isZero();
        anna.send(delete);
        await().until(() -> anna.frames().stream().anyMatch(frame -> frame.startsWith("{\"written\"")));
        assertThat(ends(Topics.DOMAIN_MANAGER)).isEqualTo(before + 1);
    }

    private static ConsumerRecord<String, String> last(String topic) {
        try (var consumer = new KafkaConsumer<>(kafka.client(), new StringDeserializer(), new StringDeserializer())) {
            List<TopicPartition> all = consumer.partitionsFor(topic).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            consumer.assign(all);
            consumer.seekToBeginning(all);
            List<ConsumerRecord<String, String>> records = new ArrayList<>();
            await().until(() -> {
                consumer.poll(Duration.ofMillis(200)).forEach(records::add);
                return !records.isEmpty();
            });
            return records.get(records.size() - 1);
        }
    }

    @Test
    void rejectsMessagesOfViewersToOtherTopicsAndInvalidOnes() throws Exception {
        SocketClient viewer = SocketClient.open(http, socket(Topics.MISSION_MANAGER, VERA));
        SocketClient operator = SocketClient.open(http, socket(Topics.MISSION_MANAGER, OLGA));
        SocketClient elsewhere = SocketClient.open(http, socket(TOPIC, OLGA));
        SocketClient large = SocketClient.open(http, socket(Topics.MISSION_MANAGER, OLGA));

        viewer.send("{\"type\":\"request\"}");
        operator.send("stop!");
        elsewhere.send("{\"id\":\"forged\"}");
        Throwable cut = catchThrowable(() -> large.send("{\"type\":\"" + "x".repeat(1024 * 1024) + "\"}"));
        if (cut != null) { // the connection was closed while sending
            assertThat(cut).hasRootCauseInstanceOf(java.io.IOException.class);
        }

        await().until(() -> viewer.frames().size() == 1 && operator.frames().size() == 1);
        assertThat(viewer.frames().get(0)).contains("forbidden").contains("'vera' is viewer");
        assertThat(operator.frames().get(0)).contains("not-json");
        await().until(() -> elsewhere.frames().stream().anyMatch(frame -> frame.contains("topic-not-allowed")));
        await().until(large::isOver);
        assertThat(viewer.isOver()).isFalse();
        assertThat(ends(Topics.MISSION_MANAGER)).isZero();
    }
}
