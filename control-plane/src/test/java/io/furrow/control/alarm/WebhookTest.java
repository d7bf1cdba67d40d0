package io.furrow.control.alarm;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.Deque;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpServer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class WebhookTest {
    private static final long NOW = 1_700_000_000_000L;

    private final List<JsonNode> posted = Collections.synchronizedList(new ArrayList<>());
    private final Deque<Integer> answers = new ArrayDeque<>();
    private HttpServer server;
    private Webhook webhook;

    @BeforeEach
    void listen() throws IOException {
        server = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        server.createContext("/hook", exchange -> {
            try {
                posted.add(NgsiJson.read(exchange.getRequestBody().readAllBytes()));
            } catch (io.furrow.model.ngsi.UnreadableException e) {
                throw new IOException(e);
            }
            exchange.sendResponseHeaders(answers.isEmpty() ? 204 : answers.pop(), -1);
            exchange.close();
        });
        server.start();
        URI url = URI.create(
                "http://127.0.0.1:%d/hook".formatted(server.getAddress().getPort()));
        webhook = new Webhook(
                new Webhook.Settings(url, 3, Duration.ofMillis(1)),
                Clock.fixed(Instant.ofEpochMilli(NOW), ZoneOffset.UTC));
    }

    @AfterEach
    void stop() {
        server.stop(0);
    }

    @Test
    void postsAnAlarmWithAnIdOfItsChange() throws Exception {
        webhook.take(alarm());
        assertThat(posted).hasSize(1);
        assertThat(posted.get(0).path("id").asText()).isEqualTo("collision-7:7");
        assertThat(posted.get(0).path("alarm").asText()).isEqualTo("collision-7");
        assertThat(posted.get(0).path("state").asText()).isEqualTo("open");
    }

    @Test
    void postsTheSameAgainUntilItIsTaken() throws Exception {
        answers.addAll(List.of(503, 429, 200));
        webhook.take(alarm());
        assertThat(posted).hasSize(3);
        assertThat(posted.get(2)).isEqualTo(posted.get(0));
    }

    @Test
    void givesUpAfterItsAttemptsAndGoesOn() throws Exception {
        answers.addAll(List.of(500, 500, 500, 500));
        webhook.take(alarm());
        assertThat(posted).hasSize(3);
        answers.clear();
        webhook.take(alarm());
        assertThat(posted).hasSize(4);
    }

    @Test
    void doesNotRepeatWhatIsRefused() throws Exception {
        answers.add(400);
        webhook.take(alarm());
        assertThat(posted).hasSize(1);
    }

    @Test
    void givesUpWhereNobodyListens() throws Exception {
        server.stop(0);
        webhook.take(alarm());
        assertThat(posted).isEmpty();
    }

    @Test
    void saysNothingOfWhatIsMutedUntilItIsNoLonger() throws Exception {
        Alarm muted = alarm().muted(NOW + 1, NOW);
        webhook.take(muted);
        webhook.take(muted.become(AlarmState.ACKNOWLEDGED, "ann", null, NOW));
        assertThat(posted).isEmpty();
        webhook.take(muted.muted(null, NOW));
        assertThat(posted).hasSize(1);
    }

    private static Alarm alarm() {
        Cause cause = new Cause(AlarmKind.COLLISION, "a-b", "close", List.of(), null);
        return Alarm.raised(cause, null, 7, NOW);
    }
}
