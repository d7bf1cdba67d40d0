package io.furrow.provisioner;

import java.io.IOException;
import java.net.URI;
import java.net.URLDecoder;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.sun.net.httpserver.HttpExchange;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Simulates an IoT Agent JSON 3.14 with one tenant, according to recorded answers and its source code: an empty list of
 * groups is 404; the devices of a batch are created one by one, and the first rejection is the answer; groups are
 * listed without pages; headers of tenant and service path are required. Tests can make it fail.
 */
final class FakeAgent implements AutoCloseable {
    final Map<String, JsonNode> devices = new LinkedHashMap<>();
    /** By resource and API key. */
    final Map<String, JsonNode> groups = new LinkedHashMap<>();
    /** Groups of other tenants. */
    final Map<String, JsonNode> hidden = new LinkedHashMap<>();
    /** Ids of devices that it rejects. */
    final Set<String> rejectedIds = new HashSet<>();
    /** Ids of devices whose creation or removal fails with 500. */
    final Set<String> broken = new HashSet<>();
    /** Ids of devices that it still creates after it has rejected their batch. */
    final Set<String> createdLate = new HashSet<>();
    /** Method and path of each changing request. */
    final List<String> changes = new CopyOnWriteArrayList<>();
    /** Values of {@code fiware-service}. */
    final Set<String> services = new HashSet<>();
    /** Values of {@code X-Farm}. */
    final Set<String> tokens = new HashSet<>();

    /** Status with which a proxy answers changing requests; 0 if it forwards them. */
    volatile int proxy;
    /** Whether it answers every request with 503. */
    volatile boolean unavailable;
    /** Fixed answer to every GET; null for the real answer. */
    volatile String fixedAnswer;
    /** Maximum number of devices of a batch; it breaks the connection of a larger batch. */
    volatile int maxBatch = Integer.MAX_VALUE;
    /** Run at each changing request. */
    volatile Runnable onChange = () -> {};

    private final StubServer server = new StubServer(this::handle);
    private final List<JsonNode> pendingBatch = new ArrayList<>();

    private static final class Rejection extends Exception {
        private static final long serialVersionUID = 1;

        private final int status;
        private final String name;

        private Rejection(int status, String name, String message) {
            super(message);
            this.status = status;
            this.name = name;
        }
    }

    URI uri() {
        return server.uri("");
    }

    synchronized Set<String> deviceIds() {
        return Set.copyOf(devices.keySet());
    }

    synchronized Set<String> apiKeys() {
        return groups.values().stream()
                .map(group -> group.path("apikey").asText())
                .collect(Collectors.toUnmodifiableSet());
    }

    synchronized void restart() {
        devices.clear();
        groups.clear();
        pendingBatch.clear();
    }

    static String key(String resource, String apiKey) {
        return resource + " " + apiKey;
    }

    @Override
    public void close() {
        server.close();
    }

    private synchronized void handle(HttpExchange exchange) throws IOException {
        try {
            if (unavailable) {
                throw new Rejection(503, "AWAY", "the registry is away");
            }
            if (proxy > 0 && !exchange.getRequestMethod().equals("GET")) {
                answer(exchange, proxy, "<html>no token</html>".getBytes(UTF_8));
                return;
            }
            if (fixedAnswer != null && exchange.getRequestMethod().equals("GET")) {
                answer(exchange, 200, fixedAnswer.getBytes(UTF_8));
                return;
            }
            answer(exchange, exchange.getRequestMethod().equals("POST") ? 201 : 200, NgsiJson.write(route(exchange)));
        } catch (Rejection e) {
            ObjectNode rejection = JsonNodeFactory.instance.objectNode().put("name", e.name);
            answer(exchange, e.status, NgsiJson.write(rejection.put("message", e.getMessage())));
        } finally {
            exchange.close(); // without an answer, which breaks the connection
        }
    }

    private static void answer(HttpExchange exchange, int status, byte[] body) throws IOException {
        exchange.getResponseHeaders().set("Content-Type", "application/json");
        exchange.sendResponseHeaders(status, body.length);
        exchange.getResponseBody().write(body);
    }

    private JsonNode route(HttpExchange exchange) throws Rejection, IOException {
        String service = exchange.getRequestHeaders().getFirst("fiware-service");
        if (service == null || exchange.getRequestHeaders().getFirst("fiware-servicepath") == null) {
            throw new Rejection(400, "MISSING_HEADERS", "Some headers were missing from the request");
        }
        services.add(service);
        tokens.add(exchange.getRequestHeaders().getFirst("X-Farm"));
        String method = exchange.getRequestMethod();
        String path = exchange.getRequestURI().getRawPath();
        boolean ofDevices = path.startsWith("/iot/devices");
        if (!method.equals("GET")) {
            changes.add(method + " " + exchange.getRequestURI().getPath());
            onChange.run();
        }
        return switch (method) {
            case "GET" -> ofDevices ? listDevices(exchange) : listGroups(service);
            case "DELETE" -> ofDevices ? removeDevice(id(path)) : removeGroup(exchange);
            default -> {
                JsonNode sent = NgsiJson.mapper().readTree(exchange.getRequestBody());
                yield ofDevices ? addDevices(sent) : addGroup(sent.at("/services/0"));
            }
        };
    }

    private static String id(String path) {
        return URLDecoder.decode(path.substring("/iot/devices/".length()), UTF_8);
    }

    private static Map<String, String> query(HttpExchange exchange) {
        Map<String, String> query = new LinkedHashMap<>();
        for (String part :
                String.valueOf(exchange.getRequestURI().getRawQuery()).split("&")) {
            String[] pair = part.split("=", 2);
            query.put(pair[0], pair.length == 1 ? null : URLDecoder.decode(pair[1], UTF_8));
        }
        return query;
    }

    private JsonNode listDevices(HttpExchange exchange) throws Rejection {
        if (exchange.getRequestURI().getRawPath().length() > "/iot/devices".length()) {
            JsonNode device = devices.get(id(exchange.getRequestURI().getRawPath()));
            if (device == null) {
                throw new Rejection(404, "DEVICE_NOT_FOUND", "No device was found with id");
            }
            return device;
        }
        Map<String, String> query = query(exchange);
        ArrayNode page = JsonNodeFactory.instance.arrayNode();
        devices.values().stream()
                .skip(Long.parseLong(query.getOrDefault("offset", "0")))
                .limit(Long.parseLong(query.getOrDefault("limit", "20")))
                .forEach(page::add);
        return JsonNodeFactory.instance
                .objectNode()
                .put("count", devices.size())
                .set("devices", page);
    }

    private JsonNode listGroups(String service) throws Rejection {
        if (groups.isEmpty()) {
            throw new Rejection(
                    404,
                    "DEVICE_GROUP_NOT_FOUND",
                    "Couldn\t find device group for fields: \"%s\" and values: \"/\"".formatted(service));
        }
        ArrayNode all = JsonNodeFactory.instance.arrayNode().addAll(groups.values());
        return JsonNodeFactory.instance.objectNode().put("count", groups.size()).set("services", all);
    }

    private JsonNode addGroup(JsonNode group) throws Rejection {
        String key = key(group.path("resource").asText(), group.path("apikey").asText());
        if (hidden.containsKey(key) || groups.putIfAbsent(key, group) != null) {
            throw new Rejection(409, "DUPLICATE_GROUP", "A device configuration already exists for resource " + key);
        }
        return JsonNodeFactory.instance.objectNode();
    }

    private JsonNode removeGroup(HttpExchange exchange) throws Rejection {
        Map<String, String> query = query(exchange);
        if (query.get("resource") == null || query.get("apikey") == null) {
            throw new Rejection(400, "MISSING_HEADERS", "Some headers were missing from the request");
        }
        if (groups.remove(key(query.get("resource"), query.get("apikey"))) == null) {
            throw new Rejection(404, "DEVICE_GROUP_NOT_FOUND", "Couldn\t find device group");
        }
        return JsonNodeFactory.instance.objectNode();
    }

    private JsonNode removeDevice(String id) throws Rejection {
        if (broken.contains(id)) {
            throw new Rejection(500, "Error", "cannot remove " + id);
        }
        if (devices.remove(id) == null) {
            throw new Rejection(404, "DEVICE_NOT_FOUND", "No device was found with id:" + id);
        }
        return JsonNodeFactory.instance.objectNode();
    }

    private JsonNode addDevices(JsonNode sent) throws Rejection, IOException {
        pendingBatch.forEach(device -> devices.put(device.path("device_id").asText(), device));
        pendingBatch.clear();
        Rejection first = null;
        int created = 0;
        for (JsonNode device : sent.path("devices")) {
            if (created == maxBatch) {
                throw new IOException("out of time");
            }
            try {
                add(device, sent.path("devices").size() > 1);
                created++;
            } catch (Rejection e) {
                first = first == null ? e : first;
            }
        }
        if (first != null) {
            throw first;
        }
        return JsonNodeFactory.instance.objectNode();
    }

    private void add(JsonNode device, boolean inABatch) throws Rejection {
        String id = device.path("device_id").asText();
        if (broken.contains(id)) {
            throw new Rejection(500, "Error", "cannot make " + id);
        }
        if (rejectedIds.contains(id)) {
            throw new Rejection(422, "REFUSED", "not " + id);
        }
        if (devices.containsKey(id)) {
            throw new Rejection(409, "DUPLICATE_DEVICE_ID", "A device with the same info was found:" + id);
        }
        if (createdLate.contains(id) && inABatch) {
            pendingBatch.add(device);
        } else {
            devices.put(id, device);
        }
    }
}
