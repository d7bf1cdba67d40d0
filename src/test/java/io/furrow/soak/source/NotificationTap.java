package io.furrow.soak.source;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.atomic.AtomicInteger;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

/**
 * Stands between a context broker and the listeners of the tasks, and remembers which changes each answered 2xx. A listener that
 * gives no answer gives none here either: the connection is closed. What is posted to {@code /<port>/…} goes to that port.
 */
final class NotificationTap implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final Set<String> OWN_HEADERS =
            Set.of("host", "connection", "content-length", "expect", "upgrade", "transfer-encoding", "accept-encoding");

    private final StubServer server = new StubServer(this::pass);
    private final HttpClient client = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(Duration.ofSeconds(2))
            .build();
    private final Map<NumberedChange, ConcurrentLinkedQueue<Try>> tries = new ConcurrentHashMap<>();
    private final AtomicInteger underWay = new AtomicInteger();
    private volatile PlantedFault fault = PlantedFault.NONE;

    /** One notification of a change to the listener on a port. @param status 0 without an answer */
    record Try(int port, int status) {
        boolean isAcknowledged() {
            return status / 100 == 2;
        }
    }

    /** The address of a source behind it; {@code {port}} is for the source to fill in. */
    String publicUrl() {
        return server.uri("") + "/{port}/v2/notify";
    }

    /** The next notification is treated so. */
    void plant(PlantedFault next) {
        fault = next;
    }

    private void pass(HttpExchange exchange) throws IOException {
        underWay.incrementAndGet();
        try (exchange) {
            byte[] body = exchange.getRequestBody().readAllBytes();
            String[] path = exchange.getRequestURI().getPath().split("/", 3);
            int port = Integer.parseInt(path[1]);
            PlantedFault planted = takeFault();
            int status = planted == PlantedFault.LOSE ? 200 : send(port, "/" + path[2], exchange, body);
            if (planted == PlantedFault.REPEAT) {
                send(port, "/" + path[2], exchange, body);
            }
            remember(body, new Try(port, status));
            if (status > 0) {
                exchange.sendResponseHeaders(status, -1);
            }
        } finally {
            underWay.decrementAndGet();
        }
    }

    private synchronized PlantedFault takeFault() {
        PlantedFault taken = fault;
        fault = PlantedFault.NONE;
        return taken;
    }

    private int send(int port, String path, HttpExchange from, byte[] body) {
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create("http://127.0.0.1:" + port + path))
                .timeout(TIMEOUT)
                .POST(HttpRequest.BodyPublishers.ofByteArray(body));
        from.getRequestHeaders().forEach((name, values) -> {
            if (!OWN_HEADERS.contains(name.toLowerCase(Locale.ROOT))) {
                values.forEach(value -> request.header(name, value));
            }
        });
        try {
            return client.send(request.build(), HttpResponse.BodyHandlers.discarding())
                    .statusCode();
        } catch (IOException e) {
            return 0;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return 0;
        }
    }

    private void remember(byte[] body, Try tried) throws IOException {
        for (JsonNode entity : NgsiJson.mapper().readTree(body).path("data")) {
            tries.computeIfAbsent(NumberedChange.of(entity), change -> new ConcurrentLinkedQueue<>())
                    .add(tried);
        }
    }

    boolean isIdle() {
        return underWay.get() == 0;
    }

    /** Every change that was notified. */
    Set<NumberedChange> changes() {
        return tries.keySet();
    }

    /** What became of its notifications. */
    List<Try> tries(NumberedChange change) {
        return List.copyOf(tries.get(change));
    }

    @Override
    public void close() {
        server.close();
    }
}
