package io.furrow.control.rest.view;

import java.io.BufferedReader;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.net.Socket;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.rest.ApiClient;
import io.furrow.control.rest.RunningApi;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Receives replays as server-sent events from a real API and Kafka. */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class ResourceFeedIT {
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private RunningApi running;
    private ApiClient client;
    private KafkaProducer<String, byte[]> player;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        client = running.client();
        player = KafkaClients.producer(running.settings().client());
    }

    @AfterAll
    void stop() {
        player.close();
        running.close();
    }

    private String startReplay() throws Exception {
        return client.ask("POST", "/api/replays", "{\"mission\":\"m\"}")
                .path("replay")
                .asText();
    }

    private void report(String replay, long sequence, ReplayStatus.State state) {
        player.send(new ProducerRecord<>(
                Topics.REPLAYS_STATUS, replay, new ReplayStatus(sequence, state, null, true, null).toBytes()));
        player.flush();
    }

    private HttpResponse<InputStream> open(String path, String... header) throws Exception {
        HttpRequest.Builder request =
                HttpRequest.newBuilder(URI.create(running.api().uri() + path));
        if (header.length > 0) {
            request.headers(header);
        }
        return http.send(request.build(), HttpResponse.BodyHandlers.ofInputStream());
    }

    private static BufferedReader events(HttpResponse<InputStream> answer) {
        assertThat(answer.statusCode()).isEqualTo(200);
        assertThat(answer.headers().firstValue("Content-Type")).contains("text/event-stream");
        return new BufferedReader(new InputStreamReader(answer.body(), UTF_8));
    }

    private static String until(BufferedReader events, String text) throws Exception {
        String line = events.readLine();
        while (line != null && !line.contains(text)) {
            line = events.readLine();
        }
        assertThat(line).as(text).isNotNull();
        return line;
    }

    @Test
    @Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
    void followsAReplayUntilItIsOver() throws Exception {
        String replay = startReplay();
        try (BufferedReader one = events(open("/api/replays/" + replay + "/events"));
                BufferedReader all = events(open("/api/replays/events"))) {
            assertThat(until(one, "event:")).isEqualTo("event: reset");
            assertThat(until(one, "event:")).isEqualTo("event: status");
            assertThat(one.readLine()).startsWith("data: {").contains(replay, "\"wanted\":\"running\"");
            report(replay, 1, ReplayStatus.State.RUNNING);
            until(one, "\"status\":{\"sequence\":1,\"state\":\"running\"}");
            until(all, "\"state\":\"running\"");
            client.send("POST", "/api/replays/" + replay + "/pause", null);
            until(one, "\"wanted\":\"paused\"");

            report(replay, 1_000_000, ReplayStatus.State.ENDED);
            until(one, "\"state\":\"ended\""); // where it can be rewound
            client.send("DELETE", "/api/replays/" + replay, null);
            until(one, "\"wanted\":\"stopped\"");
            report(replay, 1_000_001, ReplayStatus.State.STOPPED);
            until(one, "event: over");
            assertThat(one.readLine()).startsWith("data: {").contains(replay, "\"state\":\"stopped\"");
            assertThat(until(one, "id: ")).matches("id: [0-9a-f]{8}-[0-9]+");
            assertThat(one.readLine()).isEmpty();
            assertThat(one.readLine()).as("the end").isNull();
            until(all, "event: over");
            running.rejects("GET", "/api/replays/" + replay + "/events", null, 404, "unknown-replay");
        }
    }

    @Test
    @Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
    void continuesWhereAClientWas() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"followed\"}");
        String id;
        try (BufferedReader missions = events(open("/api/events/missions"))) {
            id = until(missions, "id: ").substring("id: ".length());
        }
        client.send("POST", "/api/missions", "{\"mission\":\"later\",\"domain\":\"followed\"}");
        try (BufferedReader missions = events(open("/api/v1/events/missions", "Last-Event-ID", id))) {
            assertThat(until(missions, "event: ")).isEqualTo("event: status");
            assertThat(until(missions, "data: ")).contains("\"mission\":\"later\"", "\"created\":\"20", "Z\"");
        }
    }

    /** A stream without a body would occupy a feed forever. */
    @Test
    void opensNoFeedForHeadRequests() throws Exception {
        for (int i = 0; i < 110; i++) {
            HttpRequest head = HttpRequest.newBuilder(URI.create(running.api().uri() + "/api/replays/events"))
                    .method("HEAD", HttpRequest.BodyPublishers.noBody())
                    .build();
            assertThat(http.send(head, HttpResponse.BodyHandlers.discarding()).statusCode())
                    .isEqualTo(200);
        }
    }

    /** A hundred clients that do not read must not block other requests. */
    @Test
    void isNotBlockedByClientsThatDoNotRead() throws Exception {
        String replay = startReplay();
        List<Socket> silent = new ArrayList<>();
        try {
            for (int i = 0; i < ResourceFeeds.MAX_FEEDS; i++) {
                Socket socket = new Socket(
                        running.api().uri().getHost(), running.api().uri().getPort());
                socket.getOutputStream()
                        .write("GET /api/replays/events HTTP/1.1\r\nHost: localhost\r\n\r\n".getBytes(US_ASCII));
                silent.add(socket);
            }
            await().until(() -> open("/api/replays/" + replay + "/events").statusCode() == 503);
            for (int i = 2; i < 2000; i++) {
                report(replay, i, ReplayStatus.State.RUNNING);
            }
            await().until(() ->
                    running.get("/api/replays/" + replay).at("/status/sequence").asLong() == 1999);
        } finally {
            for (Socket socket : silent) {
                socket.close();
            }
        }
        report(replay, 2000, ReplayStatus.State.RUNNING);
        await().until(() -> {
            report(replay, 2000, ReplayStatus.State.RUNNING); // a disconnected client is detected at the next write
            HttpResponse<InputStream> answer = open("/api/replays/" + replay + "/events");
            answer.body().close();
            return answer.statusCode() == 200;
        });
    }
}
