package io.furrow.dashboard;

import java.io.InputStream;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.net.http.WebSocketHandshakeException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.stream.IntStream;
import java.util.stream.LongStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.admin.RecordsToDelete;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndMetadata;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlSettings;
import io.furrow.control.readiness.Readiness;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.dashboard.feed.TopicRules;
import io.furrow.dashboard.proxy.ProxyLimits;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.http.AllowedNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowable;
import static org.awaitility.Awaitility.await;

/** In front of a real Kafka and a real REST API of the control plane. */
class DashboardIT {
    private static final String VERA = "vera-reads-only-0001";
    private static final String OLGA = "olga-commands-000001";
    private static final Duration TIMEOUT = Duration.ofSeconds(30);
    private static final String TOPIC = "data.farm.realtime.weeding";

    @TempDir
    static Path directory;

    private static EmbeddedKafka kafka;
    private static RestApi api;
    private static KafkaProducer<String, byte[]> producer;

    private final HttpClient http = HttpClient.newHttpClient();
    private Dashboard dashboard;

    @BeforeAll
    static void startTheOthers() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        Path tokens = directory.resolve("tokens");
        Files.writeString(tokens, "vera %s viewer%nolga %s operator%n".formatted(VERA, OLGA));
        api = RestApi.start(
                ControlSettings.of(client()), RestSettings.on(0).withTokens(tokens), new Readiness(Clock.systemUTC()));
        kafka.createTopics(Stream.topics(TOPIC, "data.farm.realtime", "data.m.replay.0a1b2c3d"));
        kafka.createTopics(List.of(new NewTopic(Topics.LATEST, Optional.of(2), Optional.empty())));

        producer = new KafkaProducer<>(kafka.producerSettings(), new StringSerializer(), new ByteArraySerializer());
        await().atMost(TIMEOUT).until(api::isReady);
    }

    /** Names of topics as what is to be made. */
    private interface Stream {
        static List<NewTopic> topics(String... names) {
            return List.of(names).stream()
                    .map(name -> new NewTopic(name, Optional.of(1), Optional.empty()))
                    .toList();
        }
    }

    @AfterAll
    static void stopTheOthers() {
        producer.close();
        api.close();
        kafka.close();
    }

    @BeforeEach
    void start() throws Exception {
        dashboard = Dashboard.start(settings());
    }

    @AfterEach
    void stop() {
        dashboard.close();
    }

    private static DashboardSettings settings() {
        return DashboardSettings.of(0, client(), api.uri());
    }

    private void restart(DashboardSettings other) throws Exception {
        dashboard.close();
        dashboard = Dashboard.start(other);
    }

    private static Properties client() {
        Properties client = new Properties();
        client.setProperty("bootstrap.servers", kafka.bootstrapServers());
        return client;
    }

    private HttpResponse<String> get(String path, String token, String... headers) throws Exception {
        HttpRequest.Builder request = HttpRequest.newBuilder(dashboard.uri().resolve(path));
        if (token != null) {
            request.header("Authorization", "Bearer " + token);
        }
        for (int i = 0; i < headers.length; i += 2) {
            request.header(headers[i], headers[i + 1]);
        }
        return http.send(request.build(), HttpResponse.BodyHandlers.ofString());
    }

    private static JsonNode json(HttpResponse<String> answer) throws Exception {
        return NgsiJson.read(answer.body().getBytes(UTF_8));
    }

    private String error(String path, String token, String... headers) throws Exception {
        HttpResponse<String> answer = get(path, token, headers);
        return answer.statusCode() + " " + json(answer).path("error").asText();
    }

    private URI socket(String topicAndQuery, String token) throws Exception {
        HttpResponse<String> answer = get("/api/register/" + topicAndQuery, token);
        assertThat(answer.statusCode()).as(answer.body()).isEqualTo(200);
        return URI.create(dashboard.uri().toString().replace("http", "ws")
                + json(answer).path("socket").asText());
    }

    /** Opened, and told of every record from now on. */
    private SocketClient open(String topicAndQuery) throws Exception {
        return open(topicAndQuery, true);
    }

    private SocketClient open(String topicAndQuery, boolean reads) throws Exception {
        SocketClient client = SocketClient.open(http, socket(topicAndQuery, OLGA), reads);
        int before = client.frames().size();
        String topic = topicAndQuery.replaceAll("\\?.*", "");
        await().atMost(TIMEOUT).until(() -> {
            send(topic, "probe", "{\"probe\":true}");
            return client.frames().size() > before;
        });
        return client;
    }

    private static void send(String topic, String key, String value) throws Exception {
        producer.send(new ProducerRecord<>(topic, key, value == null ? null : value.getBytes(UTF_8)))
                .get();
    }

    private static List<JsonNode> without(List<JsonNode> records, String key) {
        return records.stream()
                .filter(record -> !record.path("key").asText().equals(key))
                .toList();
    }

    @Test
    void deliversEveryRecordOfATopicInItsOrderWithAllThatBelongsToIt() throws Exception {
        SocketClient client = open(TOPIC + "?format=record");
        for (int i = 0; i < 500; i++) {
            producer.send(new ProducerRecord<>(
                    TOPIC, null, 1_777_600_000_000L + i, "k" + i % 7, ("{\"n\":" + i + "}").getBytes(UTF_8)));
        }
        send(TOPIC, "gone", null);
        send(TOPIC, "text", "no <b>JSON</b>");
        send(TOPIC, "half", "{\"a\":1} {");

        await().atMost(TIMEOUT).until(() -> without(client.records(), "probe").size() == 503);
        List<JsonNode> records = without(client.records(), "probe");
        for (int i = 0; i < 500; i++) {
            assertThat(records.get(i).at("/value/n").asInt()).isEqualTo(i);
            assertThat(records.get(i).path("key").asText()).isEqualTo("k" + i % 7);
            assertThat(records.get(i).path("time").asLong()).isEqualTo(1_777_600_000_000L + i);
            assertThat(records.get(i).path("kind").asText()).isEqualTo("event");
        }
        assertThat(records.get(500).path("value").isNull()).isTrue();
        assertThat(records.get(501).path("value").asText()).isEqualTo("no <b>JSON</b>");
        assertThat(records.get(502).path("value").asText()).isEqualTo("{\"a\":1} {");
        List<Long> sequences = client.records().stream()
                .map(record -> record.path("sequence").asLong())
                .toList();
        assertThat(sequences)
                .containsExactlyElementsOf(LongStream.range(sequences.get(0), sequences.get(0) + sequences.size())
                        .boxed()
                        .toList());
    }

    @Tag("full")
    @Test
    void deliversValuesAsTheyAreUnlessMoreIsAskedFor() throws Exception {
        SocketClient client = open(TOPIC);
        send(TOPIC, "a", "{\"id\": \"a\" }");

        await().atMost(TIMEOUT).until(() -> client.frames().contains("{\"id\": \"a\" }"));
    }

    @Test
    void sendsWhatWasKnownFirst() throws Exception {
        send(Topics.LATEST, "r1", entity("r1", "farm", "weeding", 1));
        send(Topics.LATEST, "r1", entity("r1", "farm", "weeding", 2));
        send(Topics.LATEST, "r2", entity("r2", "farm", "other", 3));
        send(Topics.LATEST, "r3", entity("r3", "elsewhere", "weeding", 4));
        send(Topics.LATEST, "r4", entity("r4", "farm", "weeding", 5));
        send(Topics.LATEST, "r4", null);

        SocketClient mission = SocketClient.open(http, socket(TOPIC + "?format=record&prime=true", VERA));
        SocketClient domain = SocketClient.open(http, socket("data.farm.realtime?format=record&prime=true", VERA));

        await().atMost(TIMEOUT)
                .until(() -> mission.frames().contains("{\"primed\":true}")
                        && domain.frames().contains("{\"primed\":true}"));
        assertThat(mission.records())
                .extracting(record -> record.path("key").asText())
                .containsExactly("r1");
        assertThat(mission.records().get(0).at("/value/n/value").asInt()).isEqualTo(2);
        assertThat(mission.records().get(0).path("kind").asText()).isEqualTo("prime");
        assertThat(mission.records().get(0).has("sequence")).isFalse();
        assertThat(domain.records())
                .extracting(record -> record.path("key").asText())
                .containsExactlyInAnyOrder("r1", "r2");
    }

    @Test
    void knowsOfAReplayWhatItsNewestEpochSaid() throws Exception {
        String topic = "data.m.replay.0a1b2c3d";
        replayed(topic, "a", "{\"n\":1}", 0, "event");
        replayed(topic, "b", "{\"n\":2}", 0, "event");
        replayed(topic, null, "{}", 0, "end");
        replayed(topic, "a", "{\"n\":3}", 1, "prime");
        replayed(topic, "a", "{\"n\":4}", 1, "event");
        replayed(topic, null, "{}", 1, "end");

        SocketClient client = SocketClient.open(http, socket(topic + "?format=record&prime=true", VERA));

        await().atMost(TIMEOUT).until(() -> client.frames().contains("{\"primed\":true}"));
        assertThat(client.records()).hasSize(1);
        assertThat(client.records().get(0).at("/value/n").asInt()).isEqualTo(4);
        assertThat(client.records().get(0).at("/headers/replay-epoch").asText()).isEqualTo("1");
    }

    @Test
    void answersWithTheHistoryOfATopic() throws Exception {
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
    void countsTheRecordsOfATopicBucketByBucket() throws Exception {
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
        // once more, from what is remembered, and up to the end of the topic
        answer = json(get(path + "?width=1000&from=" + begin + "&to=" + (begin + 10_000), VERA));
        assertThat(answer.path("counts").toString()).isEqualTo("[3,0,2,0,0,0,0,0,0,1]");

        assertThat(error(path + "?width=1000&from=0&to=1000", null)).isEqualTo("401 unauthorized");
        assertThat(error(path + "?from=0&to=1", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?width=99&from=0&to=1", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error(path + "?width=1000&from=0&to=400001", VERA)).isEqualTo("400 wrong-parameter");
        assertThat(error("/api/density/data.raw.dead?width=1000&from=0&to=1", VERA))
                .isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/density/data.nothing?width=1000&from=0&to=1", VERA))
                .isEqualTo("404 unknown-topic");
    }

    private static void replayed(String topic, String key, String value, int epoch, String kind) throws Exception {
        ProducerRecord<String, byte[]> record = new ProducerRecord<>(topic, key, value.getBytes(UTF_8));
        record.headers().add("replay-epoch", Integer.toString(epoch).getBytes(UTF_8));
        record.headers().add("replay-kind", kind.getBytes(UTF_8));
        producer.send(record).get();
    }

    private static String entity(String id, String domain, String mission, int n) {
        return """
                {"id":"%s","type":"Robot","Domain":{"type":"String","value":"%s","metadata":{}},
                 "Mission":{"type":"String","value":"%s","metadata":{}},"n":{"type":"Number","value":%d,"metadata":{}}}""".formatted(id, domain, mission, n);
    }

    @Test
    void closesASocketThatIsTooSlowAndHarmsNoOther() throws Exception {
        restart(settings().withLimits(limits(2_000, 50)));
        SocketClient quick = open(TOPIC + "?format=record");
        SocketClient slow = open(TOPIC + "?format=record", false);
        SocketClient merging = open(TOPIC + "?format=record&mode=latest", false);
        String filler = "x".repeat(4_000);
        for (int i = 0; i < 10_000; i++) {
            producer.send(new ProducerRecord<>(
                    TOPIC, "k" + i % 10, ("{\"n\":" + i + ",\"filler\":\"" + filler + "\"}").getBytes(UTF_8)));
            if (i % 500 == 0) {
                int written = i;
                producer.flush();
                await().atMost(TIMEOUT).until(() -> newest(quick) >= written - 500);
            }
        }
        producer.flush();

        await().atMost(TIMEOUT).until(() -> newest(quick) == 9_999);
        assertThat(without(quick.records(), "probe")).hasSize(10_000);
        assertThat(quick.isOver()).isFalse();
        await().atMost(TIMEOUT).until(() -> dashboard.streams().open() == 2);
        slow.readOn();
        await().atMost(TIMEOUT).until(slow::isOver);
        merging.readOn();
        await().atMost(TIMEOUT).until(() -> highest(merging) == 9_999);
        assertThat(merging.merged()).isPositive();
        assertThat(without(merging.records(), "probe").size() + merging.merged())
                .isGreaterThanOrEqualTo(10_000);
        assertThat(merging.isOver()).isFalse();
    }

    /** A newer record takes the place of an older one, not the last. */
    private static int highest(SocketClient client) throws Exception {
        return client.records().stream()
                .mapToInt(record -> record.at("/value/n").asInt(-1))
                .max()
                .orElse(-1);
    }

    private static int newest(SocketClient client) throws Exception {
        if (client.frames().isEmpty()) {
            return -1;
        }
        JsonNode last = NgsiJson.read(
                        client.frames().get(client.frames().size() - 1).getBytes(UTF_8))
                .path("records");
        return last.isEmpty() ? -1 : last.get(last.size() - 1).at("/value/n").asInt(-1);
    }

    private static ProxyLimits limits(int waiting, int streams) {
        ProxyLimits usual = ProxyLimits.DEFAULT;
        return new ProxyLimits(
                streams,
                streams,
                3,
                usual.ticketLife(),
                waiting,
                usual.waitingBytes(),
                10_000,
                usual.messageBytes(),
                5,
                usual.primeRecords());
    }

    @Test
    void refusesWhatMayNotBeReadAndWhoeverMayNotRead() throws Exception {
        restart(settings().withRules(new TopicRules(List.of("data.*"), List.of())));

        assertThat(error("/api/register/" + TOPIC, null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/register/" + TOPIC, "a-token-of-nobody-0001")).isEqualTo("401 unauthorized");
        assertThat(error("/api/topics", null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/stream/" + TOPIC, null)).isEqualTo("401 unauthorized");
        assertThat(error("/api/register/service.audit", OLGA)).isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/stream/service.audit", OLGA)).isEqualTo("403 topic-not-allowed");
        assertThat(error("/api/register/data.raw.dead", OLGA)).isEqualTo("403 topic-not-allowed");
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
    void opensASocketForNoForeignPageAndUnderNoForeignName() throws Exception {
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

        // the ticket is still good, and one for each further page that may
        assertThat(Handshake.status(socket, own, "Origin", "http://" + own)).isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), own, "Origin", "https://maps.example"))
                .isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), "farm.example")).isEqualTo(101);
        assertThat(Handshake.status(socket(TOPIC, OLGA), own)).isEqualTo(101);
    }

    /** Such as one that asks for what the server cannot do: its ticket is used, and no socket reports its end. */
    @Tag("full")
    @Test
    void freesTheStreamOfAHandshakeThatFailed() throws Exception {
        URI socket = socket(TOPIC, OLGA);
        assertThat(Handshake.status(
                        socket, socket.getAuthority(), "Sec-WebSocket-Extensions", "permessage-deflate; unknown=1"))
                .isGreaterThanOrEqualTo(400);
        assertThat(metric("streams_opened_total")).isEqualTo(1);

        await().atMost(TIMEOUT).until(() -> dashboard.streams().open() == 0);
        assertThat(metric("streams_closed_total{reason=\"client\"}")).isEqualTo(1);
    }

    @Test
    void refusesAViewerWhoCommandsAndHandsNothingOn() throws Exception {
        List<String> managers =
                List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER);
        long before = managers.stream().mapToLong(DashboardIT::ends).sum();
        long audited = ends(Topics.AUDIT);
        for (String command : List.of(
                "POST /api/domains",
                "PATCH /api/domains/farm",
                "POST /api/missions",
                "POST /api/missions/weeding/start",
                "DELETE /api/missions/weeding",
                "POST /api/devices/urn:ngsi-ld:Robot:1/commands",
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

        // what an operator commands comes through behind it, and is the only thing that does
        CompletableFuture<HttpResponse<String>> commanded =
                http.sendAsync(commanding("POST /api/domains", OLGA), HttpResponse.BodyHandlers.ofString());
        await().atMost(TIMEOUT)
                .until(() -> managers.stream().mapToLong(DashboardIT::ends).sum() > before);
        assertThat(managers.stream().mapToLong(DashboardIT::ends).sum()).isEqualTo(before + 1);
        assertThat(last(Topics.DOMAIN_MANAGER).value()).contains("\"olga\"").doesNotContain("vera");
        assertThat(ends(Topics.AUDIT)).isEqualTo(audited);
        commanded.cancel(true); // no manager runs here
    }

    private HttpRequest commanding(String command, String token) {
        String[] words = command.split(" ");
        return HttpRequest.newBuilder(dashboard.uri().resolve(words[1]))
                .header("Authorization", "Bearer " + token)
                .header("Content-Type", "application/json")
                .method(words[0], HttpRequest.BodyPublishers.ofString("{\"domain\":\"x\",\"command\":\"on\"}"))
                .build();
    }

    private HttpResponse<String> command(String command, String token) throws Exception {
        return http.send(commanding(command, token), HttpResponse.BodyHandlers.ofString());
    }

    private static int status(Throwable failure) {
        assertThat(failure).isInstanceOf(CompletionException.class);
        return ((WebSocketHandshakeException) failure.getCause()).getResponse().statusCode();
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
        SocketClient writing = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER, OLGA));
        URI third = socket(TOPIC, OLGA);
        assertThatThrownBy(() -> SocketClient.open(http, third))
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(429));
        assertThat(error("/api/stream/" + TOPIC, OLGA)).isEqualTo("429 too-many-streams");
        for (int i = 0; i < 8; i++) {
            writing.send("[]");
        }
        await().atMost(TIMEOUT)
                .until(() -> writing.frames().stream().anyMatch(frame -> frame.contains("too-many-messages")));
    }

    @Test
    void writesWhatAnOperatorSendsInTheirOwnName() throws Exception {
        SocketClient client = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER + "?format=record", OLGA));
        client.send("{\"type\":\"request\",\"domain\":\"north\",\"requestId\":\"r-1\",\"user\":\"somebody\"}");

        await().atMost(TIMEOUT)
                .until(() -> client.frames().stream().anyMatch(frame -> frame.startsWith("{\"written\"")));
        ConsumerRecord<String, String> written = last(Topics.DOMAIN_MANAGER);
        assertThat(written.key()).isEqualTo("r-1");
        assertThat(NgsiJson.read(written.value().getBytes(UTF_8)).path("user").asText())
                .isEqualTo("olga");
    }

    private static ConsumerRecord<String, String> last(String topic) {
        try (KafkaConsumer<String, String> consumer =
                new KafkaConsumer<>(client(), new StringDeserializer(), new StringDeserializer())) {
            List<TopicPartition> all = consumer.partitionsFor(topic).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            consumer.assign(all);
            consumer.seekToBeginning(all);
            List<ConsumerRecord<String, String>> records = new ArrayList<>();
            await().atMost(TIMEOUT).until(() -> {
                consumer.poll(Duration.ofMillis(200)).forEach(records::add);
                return !records.isEmpty();
            });
            return records.get(records.size() - 1);
        }
    }

    @Test
    void writesNothingForAViewerNothingElsewhereAndNothingThatIsNoRequest() throws Exception {
        SocketClient viewer = SocketClient.open(http, socket(Topics.MISSION_MANAGER, VERA));
        SocketClient operator = SocketClient.open(http, socket(Topics.MISSION_MANAGER, OLGA));
        SocketClient elsewhere = SocketClient.open(http, socket(TOPIC, OLGA));
        SocketClient large = SocketClient.open(http, socket(Topics.MISSION_MANAGER, OLGA));

        viewer.send("{\"type\":\"request\"}");
        operator.send("stop!");
        elsewhere.send("{\"id\":\"forged\"}");
        Throwable cut = catchThrowable(() -> large.send("{\"type\":\"" + "x".repeat(1024 * 1024) + "\"}"));
        if (cut != null) { // while it was sent
            assertThat(cut).hasRootCauseInstanceOf(java.io.IOException.class);
        }

        await().atMost(TIMEOUT)
                .until(() -> viewer.frames().size() == 1 && operator.frames().size() == 1);
        assertThat(viewer.frames().get(0)).contains("forbidden").contains("'vera' is viewer");
        assertThat(operator.frames().get(0)).contains("not-json");
        await().atMost(TIMEOUT)
                .until(() -> elsewhere.frames().stream().anyMatch(frame -> frame.contains("topic-not-allowed")));
        await().atMost(TIMEOUT).until(large::isOver);
        assertThat(viewer.isOver()).isFalse();
        assertThat(ends(Topics.MISSION_MANAGER)).isZero();
    }

    private static long ends(String topic) {
        try (KafkaConsumer<String, String> consumer =
                new KafkaConsumer<>(client(), new StringDeserializer(), new StringDeserializer())) {
            List<TopicPartition> all = consumer.partitionsFor(topic).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            return consumer.endOffsets(all).values().stream()
                    .mapToLong(Long::longValue)
                    .sum();
        }
    }

    @Tag("full")
    @Test
    void cutsAValueThatIsTooLong() throws Exception {
        restart(settings().withLimits(limits(2_000, 50)));
        SocketClient client = open(TOPIC + "?format=record");
        send(TOPIC, "long", "\"" + "x".repeat(20_000) + "\"");

        await().atMost(TIMEOUT).until(() -> without(client.records(), "probe").size() == 1);
        JsonNode record = without(client.records(), "probe").get(0);
        assertThat(record.path("value").isNull()).isTrue();
        assertThat(record.path("cut").asInt()).isEqualTo(20_002);
    }

    @Tag("full")
    @Test
    void freesEverythingWhenSocketsAreDropped() throws Exception {
        for (int round = 0; round < 10; round++) {
            List<SocketClient> clients = new ArrayList<>();
            for (int i = 0; i < 30; i++) {
                clients.add(SocketClient.open(
                        http, socket(i % 2 == 0 ? TOPIC : "data.farm.realtime?prime=true&mode=latest", OLGA)));
            }
            clients.forEach(SocketClient::drop);
        }

        await().atMost(TIMEOUT)
                .until(() ->
                        dashboard.streams().open() == 0 && dashboard.streams().topics() == 0);
        await().atMost(TIMEOUT)
                .until(() -> Thread.getAllStackTraces().keySet().stream()
                        .noneMatch(thread -> thread.getName().startsWith("feed-")));
        open(TOPIC).close(); // and it continues
    }

    @Tag("full")
    @Test
    void sharesOneConsumerAmongAllSocketsOfATopic() throws Exception {
        List<SocketClient> clients = new ArrayList<>();
        for (int i = 0; i < 10; i++) {
            clients.add(open(TOPIC + "?format=record"));
        }
        assertThat(dashboard.streams().topics()).isEqualTo(1);
        assertThat(Thread.getAllStackTraces().keySet().stream()
                        .filter(thread -> thread.getName().startsWith("feed-")))
                .hasSize(1);
        send(TOPIC, "one", "{\"n\":1}");
        for (SocketClient client : clients) {
            await().atMost(TIMEOUT)
                    .until(() -> without(client.records(), "probe").size() == 1);
        }
    }

    @Test
    void givesTheSameAsEvents() throws Exception {
        HttpRequest request = HttpRequest.newBuilder(dashboard.uri().resolve("/api/stream/" + TOPIC + "?prime=false"))
                .header("Authorization", "Bearer " + VERA)
                .build();
        HttpResponse<InputStream> answer = http.send(request, HttpResponse.BodyHandlers.ofInputStream());
        assertThat(answer.headers().firstValue("Content-Type"))
                .hasValueSatisfying(type -> assertThat(type).startsWith("text/event-stream"));
        StringBuilder read = new StringBuilder();
        Thread reader = new Thread(() -> {
            try (InputStream in = answer.body()) {
                byte[] buffer = new byte[8192];
                for (int n = in.read(buffer); n >= 0; n = in.read(buffer)) {
                    synchronized (read) {
                        read.append(new String(buffer, 0, n, UTF_8));
                    }
                }
            } catch (java.io.IOException e) {
                // closed below
            }
        });
        reader.setDaemon(true);
        reader.start();

        await().atMost(TIMEOUT).until(() -> {
            send(TOPIC, "e", "{\"n\":1}");
            synchronized (read) {
                return read.indexOf("data: {\"records\":[{\"topic\":\"" + TOPIC) >= 0;
            }
        });
        answer.body().close();
        await().atMost(TIMEOUT).until(() -> {
            send(TOPIC, "e", "{\"n\":1}");
            return dashboard.streams().open() == 0;
        });
    }

    @Test
    void forwardsToTheControlPlaneWithTheTokenOfTheUser() throws Exception {
        assertThat(json(get("/api/me", VERA)))
                .isEqualTo(NgsiJson.read("{\"user\":\"vera\",\"role\":\"viewer\"}".getBytes(UTF_8)));
        assertThat(error("/api/me", null)).isEqualTo("401 unauthorized");
        assertThat(get("/api/me", OLGA, "Origin", dashboard.uri().toString()).statusCode())
                .isEqualTo(200);
        assertThat(error("/api/me", OLGA, "Origin", "https://evil.example")).isEqualTo("403 foreign-origin");
        assertThat(get("/api/missions?limit=3", VERA).body()).isEqualTo("[]");
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
    }

    @Tag("full")
    @Test
    void saysThatTheControlPlaneIsAway() throws Exception {
        restart(DashboardSettings.of(0, client(), URI.create("http://127.0.0.1:1")));

        assertThat(error("/api/missions", VERA)).isEqualTo("502 control-plane-away");
        assertThat(error("/api/register/" + TOPIC, VERA)).isEqualTo("503 control-plane-away");
    }

    @Tag("full")
    @Test
    void saysHowItIsAndWhatItDid() throws Exception {
        await().atMost(TIMEOUT).until(() -> get("/ready", null).statusCode() == 200);
        assertThat(json(get("/health", null)).path("status").asText()).isEqualTo("up");
        assertThat(json(get("/ready", null)).at("/parts/kafka/state").asText()).isEqualTo("up");
        assertThat(json(get("/ready", null)).at("/parts/controlPlane/state").asText())
                .isEqualTo("up");

        SocketClient client = open(TOPIC + "?format=record");
        SocketClient writing = SocketClient.open(http, socket(Topics.DOMAIN_MANAGER + "?format=record", OLGA));
        writing.send("{\"type\":\"request\"}");
        writing.send("[]");
        error("/api/register/" + TOPIC, null);
        error("/api/register/data.raw.dead", OLGA);
        await().atMost(TIMEOUT).until(() -> metric("refused_total{reason=\"not-json\"}") == 1);
        await().atMost(TIMEOUT).until(() -> metric("messages_written_total") == 1);
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
        await().atMost(TIMEOUT).until(() -> metric("streams_closed_total{reason=\"client\"}") == 1);
        assertThat(get("/metrics", null).body()).doesNotContain(TOPIC).doesNotContain("olga");
    }

    private double metric(String name) throws Exception {
        return get("/metrics", null)
                .body()
                .lines()
                .filter(line -> line.startsWith("furrow_dashboard_" + name + " "))
                .mapToDouble(line -> Double.parseDouble(line.substring(line.lastIndexOf(' '))))
                .findFirst()
                .orElse(-1);
    }

    @Tag("full")
    @Test
    void isNotReadyWithoutTheControlPlane() throws Exception {
        restart(DashboardSettings.of(0, client(), URI.create("http://127.0.0.1:1")));

        await().atMost(TIMEOUT)
                .until(() -> json(get("/ready", null))
                        .at("/parts/kafka/state")
                        .asText()
                        .equals("up"));
        HttpResponse<String> answer = get("/ready", null);
        assertThat(answer.statusCode()).isEqualTo(503);
        assertThat(json(answer).path("status").asText()).isEqualTo("not-ready");
        assertThat(json(answer).at("/parts/controlPlane/detail").asText()).contains("ConnectException");
        assertThat(get("/health", null).statusCode()).isEqualTo(200);
    }

    /** More requests than the server has threads wait for a control plane that is silent. */
    @Tag("full")
    @Test
    void saysHowItIsAndGivesThePageOutWhileTheControlPlaneIsSilent() throws Exception {
        try (ServerSocket silent = new ServerSocket(0, 500, InetAddress.getLoopbackAddress())) {
            restart(DashboardSettings.of(0, client(), URI.create("http://127.0.0.1:" + silent.getLocalPort())));
            await().atMost(TIMEOUT).until(() -> {
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
                boolean waited = waiting.stream().noneMatch(CompletableFuture::isDone);
                waiting.forEach(each -> each.cancel(true));
                return waited && health == 200 && page == 200 && config == 200;
            });
        }
    }

    /** By what it knows already: nobody waits to find it out. */
    @Tag("full")
    @Test
    void refusesAtOnceWhileKafkaIsAway() throws Exception {
        try (ServerSocket silent = new ServerSocket(0, 50, InetAddress.getLoopbackAddress())) {
            Properties nowhere = new Properties();
            nowhere.setProperty("bootstrap.servers", "127.0.0.1:" + silent.getLocalPort());
            restart(DashboardSettings.of(0, nowhere, api.uri()));
            await().atMost(TIMEOUT).until(() -> dashboard.streams().isKafkaAway());

            long begun = System.nanoTime();
            for (int i = 0; i < 5; i++) { // each of which would wait for 5 s
                assertThat(error("/api/register/" + TOPIC, OLGA)).isEqualTo("503 kafka-away");
                assertThat(error("/api/topics", OLGA)).isEqualTo("503 kafka-away");
                assertThat(json(get("/api/platform", OLGA)).at("/kafka/state").asText())
                        .isEqualTo("away");
            }
            assertThat(Duration.ofNanos(System.nanoTime() - begun)).isLessThan(Duration.ofMinutes(1));
        }
    }

    @Tag("full")
    @Test
    void forgetsATicketThatIsOld() throws Exception {
        ProxyLimits usual = ProxyLimits.DEFAULT;
        restart(settings()
                .withLimits(new ProxyLimits(
                        10, 10, 3, Duration.ofMillis(1), 100, 1_000_000, 10_000, 1_000, 5, usual.primeRecords())));
        List<URI> old = new ArrayList<>();
        for (int i : IntStream.range(0, 5).toArray()) {
            old.add(socket(TOPIC + "?x=" + i, OLGA));
        }
        assertThatThrownBy(() -> SocketClient.open(http, old.get(0)))
                .satisfies(failure -> assertThat(status(failure)).isEqualTo(403));
    }

    @Tag("full")
    @Test
    void tellsLagAndTheDeadLettersThatAreStillThere() throws Exception {
        String topic = "counted";
        String dead = "counted.dead";
        try (Admin admin = Admin.create(client())) {
            kafka.createTopics(Stream.topics(topic, dead));
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
        assertThat(named(platform.path("deadLetters"), "topic", dead)
                        .path("records")
                        .asInt())
                .isEqualTo(2);
        assertThat(named(platform.path("groups"), "group", "counting")
                        .at("/topics/" + topic)
                        .asInt())
                .isEqualTo(4);
        assertThat(error("/api/platform", null)).isEqualTo("401 unauthorized");
    }

    private static JsonNode named(JsonNode list, String member, String name) {
        for (JsonNode each : list) {
            if (name.equals(each.path(member).asText())) {
                return each;
            }
        }
        return list.path("nothing");
    }
}
