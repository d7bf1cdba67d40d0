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

/** A webhook that remembers which alarms it took in which states, and answers 503 where it is told to. */
final class AlarmReceiver implements AutoCloseable {
    private final Map<String, Set<Long>> taken = new ConcurrentHashMap<>();
    private final Map<String, JsonNode> newest = new ConcurrentHashMap<>();
    private final AtomicLong count = new AtomicLong();
    private final StubServer server = new StubServer(this::take);
    private volatile boolean refuses;

    URI uri() {
        return server.uri("");
    }

    void refuse(boolean whether) {
        refuses = whether;
    }

    /** Whether it took an alarm in its state of a sequence. */
    boolean has(String alarm, long sequence) {
        return taken.getOrDefault(alarm, Set.of()).contains(sequence);
    }

    /** Whether it took an alarm in any state. */
    boolean has(String alarm) {
        return taken.containsKey(alarm);
    }

    /** Each alarm as it was taken last. */
    List<JsonNode> newest() {
        return List.copyOf(newest.values());
    }

    long count() {
        return count.get();
    }

    private void take(HttpExchange exchange) throws IOException {
        try (exchange) {
            JsonNode alarm =
                    NgsiJson.mapper().readTree(exchange.getRequestBody().readAllBytes());
            boolean refused = refuses;
            if (!refused) {
                String id = alarm.path("alarm").asText();
                taken.computeIfAbsent(id, any -> ConcurrentHashMap.newKeySet())
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
            exchange.sendResponseHeaders(refused ? 503 : 204, -1);
        }
    }

    @Override
    public void close() {
        server.close();
    }
}
