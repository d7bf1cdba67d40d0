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
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.journal.RecordLog;

/** A reception on a free port, whose recordLog does what the test says. */
public final class NotificationRig implements AutoCloseable {
    static final Duration TIMEOUT = Duration.ofSeconds(60);

    /** Keeps what it is given; what it says of its durability is the test's. */
    public static final class FakeRecordLog implements RecordLog {
        public final BlockingQueue<List<KafkaRecord>> taken = new LinkedBlockingQueue<>();
        public volatile Optional<CompletableFuture<Void>> answer = Optional.of(CompletableFuture.completedFuture(null));

        @Override
        public Optional<CompletableFuture<Void>> take(List<KafkaRecord> records) {
            Optional<CompletableFuture<Void>> now = answer;
            if (now.isPresent()) {
                taken.add(records);
            }
            return now;
        }
    }

    public final FakeRecordLog recordLog = new FakeRecordLog();
    final Ledger ledger = new Ledger();
    final HttpClient client = HttpClient.newHttpClient();
    private NotificationEndpoint endpoint;

    /** Starts with options; given as name, value, name, value. */
    public NotificationRig(String... options) {
        endpoint = open(0, options);
    }

    public NotificationEndpoint open(int port, String... options) {
        return open(port, TIMEOUT, options);
    }

    public NotificationEndpoint open(int port, Duration timeout, String... options) {
        Map<String, String> all =
                new HashMap<>(Map.of("listen.port", Integer.toString(port), "journal.dir", "/tmp/journal"));
        for (int i = 0; i < options.length; i += 2) {
            all.put(options[i], options[i + 1]);
        }
        return NotificationEndpoint.open(new NgsiSourceConfig(all), recordLog, ledger, subscription -> {}, timeout);
    }

    /** Another one in its place, on the same port. */
    public void replace(String... options) {
        int port = port();
        endpoint.close();
        endpoint = open(port, options);
    }

    public int port() {
        return endpoint.port();
    }

    int healthPort() {
        return endpoint.healthPort().orElseThrow();
    }

    public URI uri(String path) {
        return URI.create("http://127.0.0.1:" + port() + path);
    }

    public CompletableFuture<HttpResponse<String>> post(String body) {
        return post("/v2/notify", BodyPublishers.ofString(body));
    }

    public CompletableFuture<HttpResponse<String>> post(String path, BodyPublisher body, String... headers) {
        var request = HttpRequest.newBuilder(uri(path)).timeout(TIMEOUT).POST(body);
        return send(
                headers.length == 0 ? request.build() : request.headers(headers).build());
    }

    public CompletableFuture<HttpResponse<String>> get(String path) {
        return send(HttpRequest.newBuilder(uri(path)).build());
    }

    public CompletableFuture<HttpResponse<String>> send(HttpRequest request) {
        return client.sendAsync(request, BodyHandlers.ofString());
    }

    @Override
    public void close() {
        endpoint.close();
    }
}
