package io.furrow.fiware;

import java.io.IOException;
import java.net.URI;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Keeps every notification that it is sent and answers with a status of choice. */
public final class NotificationReceiver implements AutoCloseable {
    /**
     * @param sender the port that it was sent from
     * @param headers by name, without regard to case
     */
    public record ReceivedNotification(int sender, String path, Map<String, String> headers, String body) {
        public JsonNode json() {
            try {
                return NgsiJson.read(body.getBytes(UTF_8));
            } catch (UnreadableException e) {
                throw new AssertionError("a notification that is not JSON: " + body, e);
            }
        }
    }

    private final StubServer server = new StubServer(this::receive);
    private final List<ReceivedNotification> received = new CopyOnWriteArrayList<>();
    private volatile int status = 200;

    public NotificationReceiver answering(int other) {
        status = other;
        return this;
    }

    public URI url(String path) {
        return server.uri(path);
    }

    public List<ReceivedNotification> received() {
        return received;
    }

    public List<ReceivedNotification> at(String path) {
        return received.stream().filter(one -> one.path().equals(path)).toList();
    }

    @Override
    public void close() {
        server.close();
    }

    private void receive(HttpExchange exchange) throws IOException {
        String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
        Map<String, String> headers = new TreeMap<>(String.CASE_INSENSITIVE_ORDER);
        exchange.getRequestHeaders().forEach((name, values) -> headers.put(name, String.join(",", values)));
        received.add(new ReceivedNotification(
                exchange.getRemoteAddress().getPort(), exchange.getRequestURI().toString(), headers, body));
        StubServer.answer(exchange, status, "");
    }
}
