package io.furrow.connect.source;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublisher;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.net.http.HttpResponse.BodyHandlers;
import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;

import io.furrow.connect.ledger.Ledger;

/** A reception on a free port, whose intake does what the test says. */
final class ReceptionRig implements AutoCloseable {
    static final Duration PATIENCE = Duration.ofSeconds(60);

    /** Keeps what it is given; what it says of its durability is the test's. */
    static final class FakeIntake implements Intake {
        final BlockingQueue<List<OutgoingRecord>> taken = new LinkedBlockingQueue<>();
        volatile Optional<CompletableFuture<Void>> answer = Optional.of(CompletableFuture.completedFuture(null));

        @Override
        public Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records) {
            Optional<CompletableFuture<Void>> now = answer;
            if (now.isPresent()) {
                taken.add(records);
            }
            return now;
        }
    }

    final FakeIntake intake = new FakeIntake();
    final Ledger ledger = new Ledger();
    final HttpClient client = HttpClient.newHttpClient();
    private Reception reception;

    /** Starts with options; given as name, value, name, value. */
    ReceptionRig(String... options) {
        reception = open(0, options);
    }

    Reception open(int port, String... options) {
        return open(port, PATIENCE, options);
    }

    Reception open(int port, Duration patience, String... options) {
        Map<String, String> all =
                new HashMap<>(Map.of("listen.port", Integer.toString(port), "journal.dir", "/tmp/journal"));
        for (int i = 0; i < options.length; i += 2) {
            all.put(options[i], options[i + 1]);
        }
        return Reception.open(new NgsiSourceConfig(all), intake, ledger, patience);
    }

    /** Another one in its place, on the same port. */
    void replace(String... options) {
        int port = port();
        reception.close();
        reception = open(port, options);
    }

    int port() {
        return reception.port();
    }

    int healthPort() {
        return reception.healthPort().orElseThrow();
    }

    URI uri(String path) {
        return URI.create("http://127.0.0.1:" + port() + path);
    }

    CompletableFuture<HttpResponse<String>> post(String body) {
        return post("/v2/notify", BodyPublishers.ofString(body));
    }

    CompletableFuture<HttpResponse<String>> post(String path, BodyPublisher body, String... headers) {
        HttpRequest.Builder request =
                HttpRequest.newBuilder(uri(path)).timeout(PATIENCE).POST(body);
        return send(
                headers.length == 0 ? request.build() : request.headers(headers).build());
    }

    CompletableFuture<HttpResponse<String>> get(String path) {
        return send(HttpRequest.newBuilder(uri(path)).build());
    }

    CompletableFuture<HttpResponse<String>> send(HttpRequest request) {
        return client.sendAsync(request, BodyHandlers.ofString());
    }

    @Override
    public void close() {
        reception.close();
    }
}
