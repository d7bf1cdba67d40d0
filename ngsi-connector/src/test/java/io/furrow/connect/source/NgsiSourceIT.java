package io.furrow.connect.source;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.Header;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.ConnectRig;
import io.furrow.connect.TopicReader;
import io.furrow.embedded.FreePort;
import io.furrow.model.event.DeadLetter;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class NgsiSourceIT {
    @TempDir
    static Path directory;

    @AutoClose
    private static ConnectRig rig;

    private final HttpClient client =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private URI source;

    @BeforeAll
    static void startWorker() {
        rig = ConnectRig.start(directory);
    }

    @Test
    void writesEachRecordedNotificationAsTheRecordsOfTheGoldenFile() throws Exception {
        listen("golden");
        List<String> names = List.of("""
                        keyValues-01 simplifiedNormalized-02 simplifiedKeyValues-04 normalized-05 withdates-06
                        onlyChanged-07""".split("\\s+"));
        for (String name : names) {
            assertThat(send(RecordedRequest.of(name).to(source)).statusCode())
                    .as(name)
                    .isEqualTo(200);
        }

        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "golden")) {
            List<String> records = reader.atLeast(names.size()).stream()
                    .map(NgsiSourceIT::inGoldenForm)
                    .toList();
            assertThat(String.join("\n", records) + "\n")
                    .isEqualTo(Files.readString(Path.of("src/test/resources/notifications/golden.jsonl")));
        }
    }

    @Test
    void runsFromThePluginFolder() {
        listen("isolated");

        assertThat(Thread.getAllStackTraces().keySet())
                .filteredOn(thread -> thread.getName().startsWith("ngsi-source-"))
                .isNotEmpty()
                .allSatisfy(thread -> assertThat(
                                thread.getContextClassLoader().getClass().getSimpleName())
                        .isEqualTo("PluginClassLoader"));
        assertThat(rig.get("/connector-plugins").toString())
                .contains("\"class\":\"" + "io.furrow.connect.source.NgsiSourceConnector"
                        + "\",\"type\":\"source\",\"version\":\"0.");
    }

    private record Bad(String name, byte[] body, int status, String reason) {}

    private static List<Bad> badNotifications() {
        return List.of(
                new Bad("no JSON", bytes("temperature=21"), 400, "not-json"),
                new Bad("cut off", bytes("{\"id\": \"a\", "), 400, "not-json"),
                new Bad("empty", new byte[0], 400, "not-json"),
                new Bad("not UTF-8", new byte[] {'{', '"', (byte) 0xc3, '"', '}'}, 400, "not-json"),
                new Bad("no entity", bytes("{\"temperature\": 21}"), 400, "not-an-entity"),
                new Bad("no object", bytes("[1, 2]"), 400, "not-an-entity"),
                new Bad("deep", bytes("[".repeat(100_000) + "]".repeat(100_000)), 400, "too-deep"),
                new Bad(
                        "10 MB",
                        bytes("{\"id\": \"a\", \"x\": \"" + "y".repeat(10_000_000) + "\"}"),
                        413,
                        "too-large"));
    }

    @Test
    void answersEachBadNotificationAndHarmsNoGoodOne() throws Exception {
        listen("mixed");
        List<Bad> table = badNotifications();
        List<String> good = new ArrayList<>();
        for (Bad bad : table) {
            HttpResponse<String> answer = post(bad.body());
            assertThat(answer.statusCode()).as(bad.name()).isEqualTo(bad.status());
            assertThat(answer.body()).as(bad.name()).startsWith("{\"error\":\"" + bad.reason() + "\"");
            String id = "good-" + good.size();
            good.add(id);
            assertThat(post(bytes("{\"id\": \"" + id + "\", \"x\": 1}")).statusCode())
                    .isEqualTo(200);
        }
        assertThat(send(RecordedRequest.of("values-03").to(source)).statusCode())
                .isEqualTo(400);
        assertThat(post(bytes("{\"data\": [{\"id\": \"in-between\"}, {\"x\": 1}]}"))
                        .statusCode())
                .isEqualTo(200);
        good.add("in-between");

        List<String> reasons = Stream.concat(
                        table.stream().map(Bad::reason), Stream.of("unsupported-form", "not-an-entity"))
                .toList();
        try (TopicReader dead = new TopicReader(rig.bootstrapServers(), "mixed.dead");
                TopicReader taken = new TopicReader(rig.bootstrapServers(), "mixed")) {
            List<ConsumerRecord<String, byte[]>> letters = dead.atLeast(reasons.size());
            assertThat(letters)
                    .extracting(letter -> header(letter, DeadLetter.REASON))
                    .containsExactlyInAnyOrderElementsOf(reasons);
            for (Bad bad : table) {
                byte[] kept = Arrays.copyOf(bad.body(), Math.min(bad.body().length, 8 * 1024 * 1024));
                assertThat(letters).as(bad.name()).anyMatch(letter -> Arrays.equals(letter.value(), kept));
            }
            assertThat(taken.atLeast(good.size()))
                    .extracting(ConsumerRecord::key)
                    .containsExactlyInAnyOrderElementsOf(good);
        }
    }

    @Test
    void listensOnTheSamePortAfterARestart() throws Exception {
        listen("restarted");
        assertThat(post(bytes("{\"id\": \"before\"}")).statusCode()).isEqualTo(200);
        assertThat(health()).contains("\"requests\":1");

        rig.restart("ngsi-source");

        org.awaitility.Awaitility.await()
                .ignoreExceptions()
                .untilAsserted(() -> assertThat(health()).contains("\"requests\":0"));
        assertThat(post(bytes("{\"id\": \"after\"}")).statusCode()).isEqualTo(200);
        try (TopicReader reader = new TopicReader(rig.bootstrapServers(), "restarted")) {
            assertThat(reader.atLeast(2)).extracting(ConsumerRecord::key).containsExactlyInAnyOrder("before", "after");
        }
    }

    private void listen(String topic) {
        int port = FreePort.orFree(0);
        rig.create(
                "ngsi-source",
                Map.of(
                        "topic",
                        topic,
                        "listen.port",
                        Integer.toString(port),
                        "producer.override.max.request.size",
                        "16777216",
                        "admin.override.bootstrap.servers",
                        rig.bootstrapServers()));
        source = URI.create("http://127.0.0.1:" + port);
        org.awaitility.Awaitility.await().ignoreExceptions().until(() -> health().contains("\"requests\":0"));
    }

    private String health() throws Exception {
        return send(HttpRequest.newBuilder(source.resolve("/health")).build()).body();
    }

    private HttpResponse<String> post(byte[] body) throws Exception {
        return send(HttpRequest.newBuilder(source.resolve("/notify"))
                .POST(BodyPublishers.ofByteArray(body))
                .build());
    }

    private HttpResponse<String> send(HttpRequest request) throws Exception {
        return client.send(request, HttpResponse.BodyHandlers.ofString());
    }

    /** Everything of a record but the moment of receipt, which no file can know. */
    private static String inGoldenForm(ConsumerRecord<String, byte[]> record) {
        ObjectNode headers = JsonNodeFactory.instance.objectNode();
        for (Header header : record.headers()) {
            if (!header.key().equals("ts-source")) {
                headers.put(header.key(), new String(header.value(), UTF_8));
            }
        }
        ObjectNode golden = JsonNodeFactory.instance.objectNode();
        golden.put("key", record.key()).put("timestamp", record.timestamp());
        golden.set("headers", headers);
        golden.put("value", new String(record.value(), UTF_8));
        return golden.toString();
    }

    private static String header(ConsumerRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
