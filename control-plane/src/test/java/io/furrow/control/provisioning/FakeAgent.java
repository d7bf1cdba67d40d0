package io.furrow.control.provisioning;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;
import java.net.URLDecoder;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.sun.net.httpserver.HttpExchange;
import com.sun.net.httpserver.HttpServer;

import io.furrow.model.ngsi.NgsiJson;

/** An IoT Agent of one tenant that remembers what it is told, and refuses or is away where a test wants it so. */
final class FakeAgent implements AutoCloseable {
    private static final int PAGE = 500;

    final Map<String, JsonNode> devices = new LinkedHashMap<>();
    final Map<String, JsonNode> groups = new LinkedHashMap<>();
    /** Ids of devices that it takes on no account. */
    final Set<String> disliked = new HashSet<>();
    /** Method and path of each request that changes something. */
    final List<String> changes = new CopyOnWriteArrayList<>();

    volatile boolean away;
    private final HttpServer server;

    private FakeAgent(HttpServer server) {
        this.server = server;
    }

    static FakeAgent start() throws IOException {
        FakeAgent agent =
                new FakeAgent(HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0));
        agent.server.createContext("/", agent::handle);
        agent.server.start();
        return agent;
    }

    URI uri() {
        return URI.create("http://127.0.0.1:" + server.getAddress().getPort());
    }

    synchronized Set<String> deviceIds() {
        return Set.copyOf(devices.keySet());
    }

    synchronized Set<String> apiKeys() {
        return Set.copyOf(groups.keySet());
    }

    @Override
    public void close() {
        server.stop(0);
    }

    private synchronized void handle(HttpExchange exchange) throws IOException {
        ObjectNode answer = JsonNodeFactory.instance.objectNode();
        int status = away ? 503 : answer(exchange, answer);
        byte[] body = NgsiJson.write(answer);
        exchange.getResponseHeaders().set("Content-Type", "application/json");
        exchange.sendResponseHeaders(status, status == 204 ? -1 : body.length);
        if (status != 204) {
            exchange.getResponseBody().write(body);
        }
        exchange.close();
    }

    private int answer(HttpExchange exchange, ObjectNode answer) throws IOException {
        String method = exchange.getRequestMethod();
        String path = exchange.getRequestURI().getPath();
        String query = String.valueOf(exchange.getRequestURI().getQuery());
        if (!method.equals("GET")) {
            changes.add(method + " " + path);
        }
        boolean ofDevices = path.startsWith("/iot/devices");
        if (method.equals("GET")) {
            int offset = Integer.parseInt(query.substring(query.indexOf("offset=") + 7));
            var list = answer.putArray(ofDevices ? "devices" : "services");
            (ofDevices ? devices : groups)
                    .values().stream().skip(offset).limit(PAGE).forEach(list::add);
            return 200;
        } else if (method.equals("DELETE")) {
            String id = ofDevices
                    ? URLDecoder.decode(exchange.getRequestURI().getRawPath().substring(13), StandardCharsets.UTF_8)
                    : query.substring(query.indexOf("apikey=") + 7);
            return (ofDevices ? devices : groups).remove(id) == null ? 404 : 204;
        }
        JsonNode sent = NgsiJson.mapper().readTree(exchange.getRequestBody());
        return ofDevices ? addDevices(sent, answer) : addGroup(sent.at("/services/0"));
    }

    private int addGroup(JsonNode group) {
        return groups.putIfAbsent(group.path("apikey").asText(), group) == null ? 201 : 409;
    }

    /** All of them or none. */
    private int addDevices(JsonNode sent, ObjectNode answer) {
        List<String> ids = new ArrayList<>();
        sent.path("devices").forEach(device -> ids.add(device.path("device_id").asText()));
        for (String id : ids) {
            if (disliked.contains(id) || devices.containsKey(id)) {
                answer.put("name", "REFUSED").put("message", "not " + id);
                return devices.containsKey(id) ? 409 : 422;
            }
        }
        sent.path("devices")
                .forEach(device -> devices.put(device.path("device_id").asText(), device));
        return 201;
    }
}
