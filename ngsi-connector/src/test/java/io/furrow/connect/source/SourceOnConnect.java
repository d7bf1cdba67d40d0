package io.furrow.connect.source;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.awaitility.Awaitility;
import org.awaitility.core.ConditionFactory;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.process.Ports;

import static org.assertj.core.api.Assertions.assertThat;

/** The listener of one task of a source that runs on a worker: what a context broker sees of it, and its ledger. */
public record SourceOnConnect(int port, HttpClient client) {
    static final int NO_ANSWER = 0;

    SourceOnConnect(int port) {
        this(port, HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build());
    }

    /** Sends entities with these ids, one notification each; every one is answered 200. */
    List<String> take(String prefix, int notifications) throws InterruptedException {
        List<String> ids = IntStream.range(0, notifications)
                .mapToObj(i -> prefix + "-" + i)
                .toList();
        for (String id : ids) {
            assertThat(post(id)).as(id).isEqualTo(200);
        }
        return ids;
    }

    /** The status, or {@link #NO_ANSWER}. */
    int post(String id) throws InterruptedException {
        return post(id, "1");
    }

    int post(String id, String x) throws InterruptedException {
        HttpRequest request = HttpRequest.newBuilder(URI.create("http://127.0.0.1:" + port + "/v2/notify"))
                .timeout(Duration.ofSeconds(20))
                .POST(BodyPublishers.ofString("{\"id\": \"" + id + "\", \"x\": " + x + "}"))
                .build();
        try {
            return client.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
        } catch (IOException e) {
            return NO_ANSWER;
        }
    }

    /** A number of the ledger. */
    long ledger(String name) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(URI.create("http://127.0.0.1:" + port + "/health"))
                .timeout(Duration.ofSeconds(5))
                .build();
        JsonNode health = NgsiJson.read(
                client.send(request, HttpResponse.BodyHandlers.ofByteArray()).body());
        assertThat(health.has(name)).as("%s in %s", name, health).isTrue();
        return health.path(name).asLong();
    }

    void awaitListening() {
        await().until(() -> ledger("requests") >= 0);
    }

    /** Until nobody listens. */
    void awaitSilence() {
        await().until(() -> !Ports.isListening(port));
    }

    /** Until another task listens than the one that had counted so many requests. */
    void awaitFewerRequestsThan(long before) {
        await().until(() -> ledger("requests") < before);
    }

    /** Until all that was taken is in Kafka, committed. */
    void awaitDrained() {
        await().until(() -> ledger("pending") == 0);
    }

    /** Patient also with a listener that is being made. */
    public static ConditionFactory await() {
        return Awaitility.await().pollInterval(Duration.ofMillis(50)).ignoreExceptions();
    }
}
