package io.furrow.simulators.device;

import java.io.IOException;
import java.net.URI;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.ToIntFunction;

import com.fasterxml.jackson.databind.JsonNode;
import com.sun.net.httpserver.HttpExchange;
import org.awaitility.Awaitility;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

/** A real MQTT broker, and one HTTP server in the place of IoT Agent and context broker that records what it is asked. */
public final class FiwareServers implements AutoCloseable {
    public static final String USER = "farmer";
    public static final String PASSWORD = "plough";

    public record ReceivedRequest(String path, String service, String servicePath, String token, JsonNode body) {}

    private final List<ReceivedRequest> requested = new CopyOnWriteArrayList<>();
    private final StubServer http = new StubServer(this::answer);
    private final EmbeddedMqtt mqtt = EmbeddedMqtt.start(Map.of(USER, PASSWORD));
    private volatile ToIntFunction<ReceivedRequest> status = request -> 201;

    public FiwareServers() {
        // The broker learns its port shortly after it is bound.
        Awaitility.await().until(() -> mqtt.uri().getPort() > 0);
    }

    private void answer(HttpExchange exchange) throws IOException {
        ReceivedRequest request = new ReceivedRequest(
                exchange.getRequestURI().getPath(),
                exchange.getRequestHeaders().getFirst("fiware-service"),
                exchange.getRequestHeaders().getFirst("fiware-servicepath"),
                exchange.getRequestHeaders().getFirst(AccessToken.DEFAULT_HEADER),
                NgsiJson.mapper().readTree(exchange.getRequestBody()));
        int answer = status.applyAsInt(request);
        requested.add(request);
        StubServer.answer(exchange, answer, "");
    }

    public void answer(ToIntFunction<ReceivedRequest> decision) {
        status = decision;
    }

    /** As new: nothing asked, everything answered with 201. */
    public void reset() {
        status = request -> 201;
        requested.clear();
    }

    public void stopMqtt() {
        mqtt.close();
    }

    public List<ReceivedRequest> requested(String path) {
        return requested.stream().filter(request -> request.path().equals(path)).toList();
    }

    public FleetSettings settings(String password) {
        URI base = http.uri("");
        return new FleetSettings(base, base, mqtt.uri(), USER, password, "farm", "/fields");
    }

    public FleetSettings settings() {
        return settings(PASSWORD);
    }

    @Override
    public void close() {
        mqtt.close();
        http.close();
    }
}
