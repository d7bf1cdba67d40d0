package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLong;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

/** A webhook that stores which alarms it received in which states, and can answer 503. */
final class AlarmReceiver implements AutoCloseable {
    private final Map<String, Set<Long>> received = new ConcurrentHashMap<>();
    private final Map<String, JsonNode> newest = new ConcurrentHashMap<>();
    private final AtomicLong count = new AtomicLong();
    private final StubServer server = new StubServer(this::receive);
    private volatile boolean unavailable;

    URI uri() {
        return server.uri("");
    }

    void setUnavailable(boolean value) {
        unavailable = value;
    }

    /** Whether it received an alarm with a sequence number. */
    boolean has(String alarm, long sequence) {
        return received.getOrDefault(alarm, Set.of()).contains(sequence);
    }

    /** Whether it received an alarm in any state. */
    boolean has(String alarm) {
        return received.containsKey(alarm);
    }

    /** The newest received state of each alarm. */
    List<JsonNode> newest() {
        return List.copyOf(newest.values());
    }

    long count() {
        return count.get();
    }

    private void receive(HttpExchange exchange) throws IOException {
        try (exchange) {
            JsonNode alarm =
                    NgsiJson.mapper().readTree(exchange.getRequestBody().readAllBytes());
            boolean rejected = unavailable;
            if (!rejected) {
                String id = alarm.path("alarm").asText();
                received.computeIfAbsent(id, any -> ConcurrentHashMap.newKeySet())
                        .add(alarm.path("sequence").asLong());
                newest.merge(
                        id,
                        alarm,
                        (one, other) -> one.path("sequence").asLong()
                                        > other.path("sequence").asLong()
                                ? one
                                : other);
                count.incrementAndGet();
            }
            exchange.sendResponseHeaders(rejected ? 503 : 204, -1);
        }
    }

    @Override
    public void close() {
        server.close();
    }
}
