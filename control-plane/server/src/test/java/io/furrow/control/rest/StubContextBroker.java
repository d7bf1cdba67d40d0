package io.furrow.control.rest;

import java.io.IOException;
import java.net.URI;
import java.util.Map;
import java.util.concurrent.CountDownLatch;

import com.sun.net.httpserver.HttpExchange;

import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Accepts or rejects updates, and records the last one. */
final class StubContextBroker implements AutoCloseable {
    private static final Map<Integer, String> ERRORS = Map.of(
            400, "{\"error\":\"BadRequest\"}",
            404, "{\"error\":\"NotFound\"}",
            409, "{\"error\":\"TooManyResults\"}",
            422, "{\"error\":\"Unprocessable\"}");

    private final StubServer server = new StubServer(this::take);
    private volatile String last = "";
    private volatile String scope = "";
    private volatile int status = 204;
    private volatile CountDownLatch held = new CountDownLatch(0);

    URI uri() {
        return server.uri("");
    }

    String last() {
        return last;
    }

    /** Tenant and service path of the last request. */
    String scope() {
        return scope;
    }

    /** Does not answer until the latch is open. */
    void hold(CountDownLatch until) {
        held = until;
    }

    void answerWith(int newStatus) {
        status = newStatus;
    }

    private void take(HttpExchange exchange) throws IOException {
        String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
        last = exchange.getRequestURI() + " " + body;
        scope = exchange.getRequestHeaders().getFirst("Fiware-Service") + " "
                + exchange.getRequestHeaders().getFirst("Fiware-Servicepath");
        try {
            held.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        StubServer.answer(exchange, status, ERRORS.getOrDefault(status, ""));
    }

    @Override
    public void close() {
        server.close();
    }
}
