package io.furrow.dashboard.status;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.model.text.FailureText;

/**
 * What the dashboard stands in front of, asked every two seconds: Kafka and the control plane. One counts as away after six seconds
 * without an answer.
 */
public final class BackendHealth implements AutoCloseable {
    private static final Duration INTERVAL = Duration.ofSeconds(2);
    private static final Duration TIMEOUT = Duration.ofSeconds(2);
    private static final Duration UNAVAILABLE_AFTER = Duration.ofSeconds(6);
    private static final int SERVER_ERROR = 500;

    private final Clock clock;
    private final List<Part> parts;
    private final ScheduledExecutorService executor;

    /** Comes back where it is there. */
    private interface Check {
        void run() throws IOException, ExecutionException, TimeoutException, InterruptedException;
    }

    /** Written by one thread. */
    private static final class Part {
        private final String name;
        private final Check check;
        private volatile Instant lastSuccess;
        private volatile String failure = "not asked yet";

        Part(String name, Check check) {
            this.name = name;
            this.check = check;
        }
    }

    /** @param controlPlane base of its REST API */
    public BackendHealth(TopicStreams streams, URI controlPlane, Clock clock) {
        this.clock = clock;
        HttpClient client = HttpClient.newBuilder()
                .version(HttpClient.Version.HTTP_1_1)
                .connectTimeout(TIMEOUT)
                .build();
        URI health = URI.create(controlPlane.toString().replaceAll("/+$", "") + "/health");
        HttpRequest request = HttpRequest.newBuilder(health).timeout(TIMEOUT).build();
        this.parts = List.of(
                new Part("kafka", () -> streams.checkKafka(TIMEOUT)),
                new Part("controlPlane", () -> probe(client, request)));
        this.executor = Executors.newScheduledThreadPool(parts.size(), task -> {
            Thread thread = new Thread(task, "surroundings");
            thread.setDaemon(true);
            return thread;
        });
        for (Part part : parts) {
            executor.scheduleWithFixedDelay(() -> poll(part), 0, INTERVAL.toMillis(), TimeUnit.MILLISECONDS);
        }
    }

    private static void probe(HttpClient client, HttpRequest request) throws IOException, InterruptedException {
        int status =
                client.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
        if (status >= SERVER_ERROR) {
            throw new IOException("%s answers %d".formatted(request.uri(), status));
        }
    }

    private void poll(Part part) {
        try {
            part.check.run();
            part.lastSuccess = clock.instant();
            part.failure = "";
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (IOException | ExecutionException | TimeoutException | RuntimeException e) { // it is not there
            part.failure = FailureText.of(e);
        }
    }

    private boolean isUp(Part part) {
        Instant last = part.lastSuccess;
        return last != null && last.plus(UNAVAILABLE_AFTER).isAfter(clock.instant());
    }

    /** Whether all of them answer. */
    boolean areUp() {
        return parts.stream().allMatch(this::isUp);
    }

    /** In the shape of the control plane's pages. */
    ObjectNode page(String status) {
        ObjectNode page = JsonNodeFactory.instance.objectNode().put("status", status);
        ObjectNode described = page.putObject("parts");
        for (Part part : parts) {
            ObjectNode json = described.putObject(part.name).put("state", isUp(part) ? "up" : "down");
            Instant last = part.lastSuccess;
            if (last != null) {
                json.put("lastSuccess", last.toString());
                long age = Math.max(0, Duration.between(last, clock.instant()).toMillis());
                json.put("ageSeconds", age / 1000.0);
            }
            if (!part.failure.isEmpty()) {
                json.put("detail", part.failure);
            }
        }
        return page;
    }

    @Override
    public void close() {
        executor.shutdownNow();
    }
}
