package io.furrow.dashboard;

import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.URI;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.stream.IntStream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.common.acl.AccessControlEntry;
import org.apache.kafka.common.acl.AclBinding;
import org.apache.kafka.common.acl.AclOperation;
import org.apache.kafka.common.acl.AclPermissionType;
import org.apache.kafka.common.resource.PatternType;
import org.apache.kafka.common.resource.ResourcePattern;
import org.apache.kafka.common.resource.ResourceType;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.http.AllowedNames;
import io.furrow.model.topic.TopicRules;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** Requests that are rejected, with their status and error. */
class DashboardRejectionsIT extends DashboardFixture {
    @Test
    void rejectsUnreadableTopicsUnknownTokensAndInvalidParameters() throws Exception {
        restart(settings().withRules(new TopicRules(List.of("data.*"), List.of())));

        assertThat(error("/api/register/" + TOPIC, null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/register/" + TOPIC, "a-token-of-nobody-0001")).isEqualTo("401 unauthorized");
        assertThat(error("/tiles/base.pmtiles", null)).isEqualTo("404 not-found");
        assertThat(error("/api/topics", null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/stream/" + TOPIC, null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/register/service.audit", OLGA)).isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/stream/service.audit", OLGA)).isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/register/data.raw.dead", OLGA)).isEqualTo("403 topic-not-allowed");
        for (String records : List.of("topics/service.audit", "v1/topics/service.audit", "%74opics/service%2eaudit")) {
            assertThat(error("/api/" + records + "/records", OLGA)).isEqualTo("403 topic-not-allowed");
        }
        assertThat(get("/api/topics/" + TOPIC + "/records", VERA).statusCode()).isEqualTo(200);
        assertThat(error("/api/register/data.nosuch", OLGA)).isEqualTo("404 unknown-topic");
        assertThat(error("/api/register/", OLGA)).isEqualTo("400 illegal-topic");
        assertThat(error("/api/register/" + TOPIC + "?mode=some", OLGA)).isEqualTo("400 wrong-parameter");
        assertThat(error("/api/register/" + TOPIC + "?prime=maybe", OLGA)).isEqualTo("400 wrong-parameter");
        assertThat(error("/api/register/" + TOPIC, OLGA, "Origin", "https://evil.example"))
                .isEqualTo("403 foreign-origin");
        assertThat(get("/api/topics", VERA).body())
                .contains(TOPIC)
                .doesNotContain("service.")
                .doesNotContain(".dead");
        assertThat(get("/api/topics?name=nosuch&name=data.no%20name&name=service.missions&name=" + TOPIC, VERA)
                        .body())
                .startsWith("[{\"name\":\"" + TOPIC + "\"")
                .doesNotContain("nosuch", "no name", "service.");
    }

    @Test
    void doesNotKnowATopicThatAclsHide() throws Exception {
        kafka.createTopics(topics("data.hidden"));
        AclBinding denied = new AclBinding(
                new ResourcePattern(ResourceType.TOPIC, "data.hidden", PatternType.LITERAL),
                new AccessControlEntry("User:ANONYMOUS", "*", AclOperation.DESCRIBE, AclPermissionType.DENY));
        try (Admin admin = Admin.create(kafka.client())) {
            admin.createAcls(List.of(denied)).all().get();
        }

        await().untilAsserted(() ->
                assertThat(get("/api/topics", VERA).body()).contains(TOPIC).doesNotContain("data.hidden"));
        assertThat(error("/api/register/data.hidden", OLGA)).isEqualTo("404 unknown-topic");
        assertThat(error("/api/stream/data.hidden", OLGA)).isEqualTo("404 unknown-topic");
    }

    @Test
    void opensASocketOnceAndForItsOwnPageOnly() throws Exception {
        URI socket = socket(TOPIC, OLGA);
        assertThatThrownBy(() -> http.newWebSocketBuilder()
                        .header("Origin", "https://evil.example")
                        .buildAsync(socket, new java.net.http.WebSocket.Listener() {})
                        .join())
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(403));
        SocketClient first = SocketClient.open(http, socket);
        assertThatThrownBy(() -> SocketClient.open(http, socket))
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(403));
        assertThat(first.isOver()).isFalse();
    }

    @Test
    void opensNoSocketForAForeignOriginOrHost() throws Exception {
        restart(settings().withAllowed(new AllowedNames(List.of("farm.example"), List.of("https://maps.example"))));
        URI socket = socket(TOPIC, OLGA);
        String own = socket.getAuthority();

        for (String origin : List.of(
                "https://evil.example",
                "http://" + socket.getHost() + ":1",
                "https://" + own,
                "null",
                "http://" + own + ".evil.example")) {
            assertThat(Handshake.status(socket, own, "Origin", origin))
                    .as(origin)
                    .isEqualTo(403);
        }
        assertThat(Handshake.status(socket, "evil.example")).isEqualTo(403);
        assertThat(metric("refused_total{reason=\"foreign-origin\"}")).isEqualTo(5);
        assertThat(metric("refused_total{reason=\"foreign-host\"}")).isEqualTo(1);
        assertThat(metric("streams_opened_total")).isZero();

        // the ticket is still valid for an allowed origin
        assertThat(Handshake.status(socket, own, "Origin", "http://" + own)).isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), own, "Origin", "https://maps.example"))
                .isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), "farm.example")).isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), own)).isEqualTo(101);
    }

    @Tag("full")
    @Test
    void limitsTicketsStreamsAndMessagesOfAClient() throws Exception {
        restart(settings().withLimits(limits(2_000, 2)));
        for (int i = 0; i < 3; i++) {
            socket(TOPIC, OLGA);
        }
        assertThat(error("/api/register/" + TOPIC, OLGA)).isEqualTo("429 too-many-tickets");

        restart(settings().withLimits(limits(2_000, 2)));
        SocketClient.open(http, socket(TOPIC, OLGA));
        SocketClient writer = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER, OLGA));
        URI third = socket(TOPIC, OLGA);
        assertThatThrownBy(() -> SocketClient.open(http, third))
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(429));
        assertThat(error("/api/stream/" + TOPIC, OLGA)).isEqualTo("429 too-many-streams");
        for (int i = 0; i < 8; i++) {
            writer.send("[]");
        }
        await().until(() -> writer.frames().stream().anyMatch(frame -> frame.contains("too-many-messages")));
    }

    @Tag("full")
    @Test
    void rejectsAnExpiredTicket() throws Exception {
        StreamLimits defaults = StreamLimits.DEFAULT;
        restart(settings()
                .withLimits(new StreamLimits(
                        10, 10, 3, Duration.ofMillis(1), 100, 1_000_000, 10_000, 1_000, 5, defaults.primeRecords())));
        List<URI> expired = new ArrayList<>();
        for (int i : IntStream.range(0, 5).toArray()) {
            expired.add(socket(TOPIC + "?x=" + i, OLGA));
        }
        assertThatThrownBy(() -> SocketClient.open(http, expired.get(0)))
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(403));
    }

    @Tag("full")
    @Test
    void reportsThatTheControlPlaneIsUnavailable() throws Exception {
        restart(DashboardSettings.of(0, kafka.client(), URI.create("http://127.0.0.1:1")));

        assertThat(error("/api/missions", VERA)).isEqualTo("502 control-plane-away");
        assertThat(error("/api/register/" + TOPIC, VERA)).isEqualTo("503 control-plane-away");
    }

    /** The dashboard already knows that Kafka is unavailable, so no request waits for a timeout. */
    @Tag("full")
    @Test
    void rejectsAtOnceWhileKafkaIsUnavailable() throws Exception {
        try (ServerSocket silent = new ServerSocket(0, 50, InetAddress.getLoopbackAddress())) {
            Properties client = new Properties();
            client.setProperty("bootstrap.servers", "127.0.0.1:" + silent.getLocalPort());
            restart(DashboardSettings.of(0, client, api.uri()));
            await().until(() -> dashboard.streams().feeds().isKafkaUnavailable());

            long startedAt = System.nanoTime();
            for (int i = 0; i < 5; i++) { // each would wait for 5 s
                assertThat(error("/api/register/" + TOPIC, OLGA)).isEqualTo("503 kafka-away");
                assertThat(error("/api/topics", OLGA)).isEqualTo("503 kafka-away");
                assertThat(json(get("/api/platform", OLGA)).at("/kafka/state").asText())
                        .isEqualTo("away");
            }
            assertThat(Duration.ofNanos(System.nanoTime() - startedAt)).isLessThan(Duration.ofMinutes(1));
        }
    }
}
