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
 * Forwards notifications from a context broker to the listeners of the tasks, and stores which changes were answered
 * 2xx. If a listener does not answer, the connection is closed. Requests to {@code /<port>/…} are forwarded to that
 * port.
 */
final class NotificationTap implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final Set<String> OWN_HEADERS =
            Set.of("host", "connection", "content-length", "expect", "upgrade", "transfer-encoding", "accept-encoding");

    private final StubServer server = new StubServer(this::forward);
    private final HttpClient client = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(Duration.ofSeconds(2))
            .build();
    private final Map<NumberedChange, ConcurrentLinkedQueue<Try>> tries = new ConcurrentHashMap<>();
    private final AtomicInteger pending = new AtomicInteger();
    private volatile PlantedFault fault = PlantedFault.NONE;

    /** A notification of a change to the listener on a port. @param status 0 without a response */
    record Try(int port, int status) {
        boolean isAcknowledged() {
            return status / 100 == 2;
        }
    }

    /** The address for a source behind the tap; the source replaces {@code {port}}. */
    String publicUrl() {
        return server.uri("") + "/{port}/v2/notify";
    }

    /** Applies a fault to the next notification. */
    void insertFault(PlantedFault next) {
        fault = next;
    }

    private void forward(HttpExchange exchange) throws IOException {
        pending.incrementAndGet();
        try (exchange) {
            byte[] body = exchange.getRequestBody().readAllBytes();
            String[] path = exchange.getRequestURI().getPath().split("/", 3);
            int port = Integer.parseInt(path[1]);
            PlantedFault current = removeFault();
            int status = current == PlantedFault.LOSE ? 200 : send(port, "/" + path[2], exchange, body);
            if (current == PlantedFault.REPEAT) {
                send(port, "/" + path[2], exchange, body);
            }
            store(body, new Try(port, status));
            if (status > 0) {
                exchange.sendResponseHeaders(status, -1);
            }
        } finally {
            pending.decrementAndGet();
        }
    }

    private synchronized PlantedFault removeFault() {
        PlantedFault current = fault;
        fault = PlantedFault.NONE;
        return current;
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

    private void store(byte[] body, Try tried) throws IOException {
        for (JsonNode entity : NgsiJson.mapper().readTree(body).path("data")) {
            tries.computeIfAbsent(NumberedChange.of(entity), change -> new ConcurrentLinkedQueue<>())
                    .add(tried);
        }
    }

    boolean isIdle() {
        return pending.get() == 0;
    }

    /** All notified changes. */
    Set<NumberedChange> changes() {
        return tries.keySet();
    }

    /** The notifications of a change. */
    List<Try> tries(NumberedChange change) {
        return List.copyOf(tries.get(change));
    }

    @Override
    public void close() {
        server.close();
    }
}
