package io.furrow.soak.year;

import java.io.IOException;
import java.net.URI;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.soak.control.Http;
import io.furrow.stub.StubServer;

/** Forwards notifications from the context broker to the source, and stores when each report was answered 2xx. */
final class Tap implements AutoCloseable {
    private final StubServer server;
    private final Map<Report, Long> acknowledged = new ConcurrentHashMap<>();

    /** A report: entity and time, epoch ms. */
    record Report(String entity, long time) {
        static Report of(JsonNode entity) {
            return new Report(
                    entity.path("id").asText(), entity.at("/Time/value").asLong());
        }
    }

    /** @param listener port of the suite's source */
    Tap(int listener) {
        server = new StubServer(exchange -> forward(exchange, listener));
    }

    String publicUrl() {
        return server.uri("/v2/notify").toString();
    }

    private void forward(HttpExchange exchange, int listener) throws IOException {
        try (exchange) {
            byte[] body = exchange.getRequestBody().readAllBytes();
            URI to = URI.create("http://127.0.0.1:" + listener + exchange.getRequestURI());
            int status = Http.send("POST", to, body, headers(exchange)).join().status();
            if (status / 100 == 2) {
                long now = System.currentTimeMillis();
                for (JsonNode entity : NgsiJson.mapper().readTree(body).path("data")) {
                    if (entity.at("/Time/value").isNumber()) { // a report of a device, not a result of analytics
                        acknowledged.putIfAbsent(Report.of(entity), now);
                    }
                }
            }
            if (status > 0) { // otherwise the context broker gets no answer either
                exchange.sendResponseHeaders(status, -1);
            }
        }
    }

    private static String[] headers(HttpExchange exchange) {
        return exchange.getRequestHeaders().entrySet().stream()
                .filter(header ->
                        header.getKey().toLowerCase(java.util.Locale.ROOT).matches("fiware-.*|ngsiv2-.*"))
                .flatMap(header -> java.util.stream.Stream.of(
                        header.getKey(), header.getValue().get(0)))
                .toArray(String[]::new);
    }

    /** When each report was acknowledged, epoch ms. */
    Map<Report, Long> acknowledged() {
        return acknowledged;
    }

    @Override
    public void close() {
        server.close();
    }
}
