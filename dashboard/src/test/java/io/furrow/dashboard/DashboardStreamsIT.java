package io.furrow.dashboard;

import java.io.InputStream;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.LongStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Records of streams, their order, and streams that are slow or dropped. */
class DashboardStreamsIT extends DashboardFixture {
    @Test
    void sendsEveryRecordOfATopicInOrderWithKeyTimeAndHeaders() throws Exception {
        SocketClient client = open(TOPIC + "?format=record");
        for (int i = 0; i < 500; i++) {
            producer.send(new ProducerRecord<>(
                    TOPIC, null, 1_777_600_000_000L + i, "k" + i % 7, ("{\"n\":" + i + "}").getBytes(UTF_8)));
        }
        send(TOPIC, "gone", null);
        send(TOPIC, "text", "no <b>JSON</b>");
        send(TOPIC, "half", "{\"a\":1} {");

        await().until(() -> without(client.records(), "probe").size() == 503);
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
    void sendsUnchangedValuesByDefault() throws Exception {
        SocketClient client = open(TOPIC);
        send(TOPIC, "a", "{\"id\": \"a\" }");

        await().until(() -> client.frames().contains("{\"id\": \"a\" }"));
    }

    @Test
    void sendsTheInitialStateFirst() throws Exception {
        send(Topics.LATEST, "r1", entity("r1", "farm", "weeding", 1));
        send(Topics.LATEST, "r1", entity("r1", "farm", "weeding", 2));
        send(Topics.LATEST, "r2", entity("r2", "farm", "other", 3));
        send(Topics.LATEST, "r3", entity("r3", "elsewhere", "weeding", 4));
        send(Topics.LATEST, "r4", entity("r4", "farm", "weeding", 5));
        send(Topics.LATEST, "r4", null);

        SocketClient mission = SocketClient.open(http, socket(TOPIC + "?format=record&prime=true", VERA));
        SocketClient domain = SocketClient.open(http, socket("data.farm.realtime?format=record&prime=true", VERA));

        await().until(() -> mission.frames().contains("{\"primed\":true}")
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

    private static String entity(String id, String domain, String mission, int n) {
        return """
                {"id":"%s","type":"Robot","Domain":{"type":"String","value":"%s","metadata":{}},
                 "Mission":{"type":"String","value":"%s","metadata":{}},"n":{"type":"Number","value":%d,"metadata":{}}}""".formatted(id, domain, mission, n);
    }

    @Test
    void sendsTheNewestEpochOfAReplay() throws Exception {
        String topic = REPLAY;
        sendReplayed(topic, "a", "{\"n\":1}", 0, "event");
        sendReplayed(topic, "b", "{\"n\":2}", 0, "event");
        sendReplayed(topic, null, "{}", 0, "end");
        sendReplayed(topic, "a", "{\"n\":3}", 1, "prime");
        sendReplayed(topic, "a", "{\"n\":4}", 1, "event");
        sendReplayed(topic, null, "{}", 1, "end");

        SocketClient client = SocketClient.open(http, socket(topic + "?format=record&prime=true", VERA));

        await().until(() -> client.frames().contains("{\"primed\":true}"));
        assertThat(client.records()).hasSize(1);
        assertThat(client.records().get(0).at("/value/n").asInt()).isEqualTo(4);
        assertThat(client.records().get(0).at("/headers/replay-epoch").asText()).isEqualTo("1");
    }

    @Test
    void sendsTheLastHourOfATopicThatIsNotCompactedWhateverItsSize() throws Exception {
        String topic = "data.history";
        kafka.createTopics(topics(topic));
        long now = System.currentTimeMillis();
        for (int i = 0; i < 100_000; i++) {
            long time = now - Duration.ofHours(2).toMillis() + i;
            producer.send(
                    new ProducerRecord<>(topic, 0, time, "pair-" + i % 50, "{\"phase\":\"ongoing\"}".getBytes(UTF_8)));
        }
        send(topic, "pair-of-now", "{\"phase\":\"started\"}");
        List<SocketClient> clients = new ArrayList<>();
        for (int i = 0; i < 5; i++) {
            clients.add(SocketClient.open(http, socket(topic + "?format=record&prime=true", VERA)));
        }
        clients.add(SocketClient.open(http, socket(TOPIC + "?format=record&prime=true", VERA)));

        for (SocketClient client : clients) {
            await().atMost(Duration.ofSeconds(5)).until(() -> client.frames().contains("{\"primed\":true}"));
        }
        assertThat(clients.subList(0, 5))
                .allSatisfy(client -> assertThat(client.records())
                        .extracting(record -> record.path("key").asText())
                        .containsExactly("pair-of-now"));
    }

    private static void sendReplayed(String topic, String key, String value, int epoch, String kind) throws Exception {
        ProducerRecord<String, byte[]> record = new ProducerRecord<>(topic, key, value.getBytes(UTF_8));
        record.headers().add("replay-epoch", Integer.toString(epoch).getBytes(UTF_8));
        record.headers().add("replay-kind", kind.getBytes(UTF_8));
        producer.send(record).get();
    }

    @Tag("full")
    @Test
    void closesASocketThatIsTooSlowWithoutDelayingOthers() throws Exception {
        restart(settings().withLimits(limits(2_000, 50)));
        SocketClient quick = open(TOPIC + "?format=record");
        Socket slow = Handshake.open(socket(TOPIC + "?format=record", OLGA));
        SocketClient merging = open(TOPIC + "?format=record&mode=latest", false);
        String filler = "x".repeat(4_000);
        for (int i = 0; i < 10_000; i++) {
            producer.send(new ProducerRecord<>(
                    TOPIC, "k" + i % 10, ("{\"n\":" + i + ",\"filler\":\"" + filler + "\"}").getBytes(UTF_8)));
            if (i % 500 == 0) {
                int written = i;
                producer.flush();
                await().until(() -> newest(quick) >= written - 500);
            }
        }
        producer.flush();

        await().until(() -> newest(quick) == 9_999);
        assertThat(without(quick.records(), "probe")).hasSize(10_000);
        assertThat(quick.isOver()).isFalse();
        await().until(() -> dashboard.streams().open() == 2);
        slow.setSoTimeout(30_000);
        assertThat(slow.getInputStream().readAllBytes()).isNotEmpty(); // to the end of the connection
        slow.close();
        merging.resume();
        await().until(() -> highest(merging) == 9_999);
        assertThat(merging.merged()).isPositive();
        assertThat(without(merging.records(), "probe").size() + merging.merged())
                .isGreaterThanOrEqualTo(10_000);
        assertThat(merging.isOver()).isFalse();
    }

    /** The last record need not be the newest, as newer records take the position of older ones. */
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

    @Tag("full")
    @Test
    void cutsAValueThatIsTooLong() throws Exception {
        restart(settings().withLimits(limits(2_000, 50)));
        SocketClient client = open(TOPIC + "?format=record");
        send(TOPIC, "long", "\"" + "x".repeat(20_000) + "\"");

        await().until(() -> without(client.records(), "probe").size() == 1);
        JsonNode record = without(client.records(), "probe").get(0);
        assertThat(record.path("value").isNull()).isTrue();
        assertThat(record.path("cut").asInt()).isEqualTo(20_002);
    }

    @Tag("full")
    @Test
    void releasesEverythingWhenSocketsAreDropped() throws Exception {
        for (int round = 0; round < 10; round++) {
            List<SocketClient> clients = new ArrayList<>();
            for (int i = 0; i < 30; i++) {
                clients.add(SocketClient.open(
                        http, socket(i % 2 == 0 ? TOPIC : "data.farm.realtime?prime=true&mode=latest", OLGA)));
            }
            clients.forEach(SocketClient::drop);
        }

        await().until(() ->
                dashboard.streams().open() == 0 && dashboard.streams().feeds().size() == 0);
        await().until(() -> Thread.getAllStackTraces().keySet().stream()
                .noneMatch(thread -> thread.getName().startsWith("feed-")));
        open(TOPIC).close(); // topics can be read again
    }

    /**
     * Negotiates an unsupported extension, so the handshake fails after its ticket was used, and no socket is closed.
     */
    @Tag("full")
    @Test
    void releasesTheStreamOfAFailedHandshake() throws Exception {
        URI socket = socket(TOPIC, OLGA);
        assertThat(Handshake.status(
                        socket, socket.getAuthority(), "Sec-WebSocket-Extensions", "permessage-deflate; unknown=1"))
                .isGreaterThanOrEqualTo(400);
        assertThat(metric("streams_opened_total")).isEqualTo(1);

        await().until(() -> dashboard.streams().open() == 0);
        assertThat(metric("streams_closed_total{reason=\"client\"}")).isEqualTo(1);
    }

    @Tag("full")
    @Test
    void endsTheStreamsOfADeletedTopicAndReadsItAfterItIsCreatedAgain() throws Exception {
        String topic = "data.m.replay.1a2b3c4d";
        kafka.createTopics(topics(topic));
        SocketClient client = open(topic);

        try (Admin admin = Admin.create(kafka.client())) {
            admin.deleteTopics(List.of(topic)).all().get();
            await().until(client::isOver);
            assertThat(client.reason()).isEqualTo("topic 'data.m.replay.1a2b3c4d' is not there any more");
            await().ignoreExceptions() // while the old topic is being deleted
                    .until(() -> admin.createTopics(topics(topic)).all().get() == null);
        }
        open(topic).close();
    }

    @Tag("full")
    @Test
    void sharesOneConsumerAmongAllSocketsOfATopic() throws Exception {
        List<SocketClient> clients = new ArrayList<>();
        for (int i = 0; i < 10; i++) {
            clients.add(open(TOPIC + "?format=record"));
        }
        assertThat(dashboard.streams().feeds().size()).isEqualTo(1);
        assertThat(Thread.getAllStackTraces().keySet().stream()
                        .filter(thread -> thread.getName().startsWith("feed-")))
                .hasSize(1);
        send(TOPIC, "one", "{\"n\":1}");
        for (SocketClient client : clients) {
            await().until(() -> without(client.records(), "probe").size() == 1);
        }
    }

    @Test
    void sendsTheSameRecordsAsServerSentEvents() throws Exception {
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

        await().until(() -> {
            send(TOPIC, "e", "{\"n\":1}");
            synchronized (read) {
                return read.indexOf("data: {\"records\":[{\"topic\":\"" + TOPIC) >= 0;
            }
        });
        answer.body().close();
        await().until(() -> {
            send(TOPIC, "e", "{\"n\":1}");
            return dashboard.streams().open() == 0;
        });
    }
}
