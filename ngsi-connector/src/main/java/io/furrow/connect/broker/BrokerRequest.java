package io.furrow.connect.broker;

import java.util.HashMap;
import java.util.Map;
import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/**
 * One request.
 *
 * @param scope sent as {@code Fiware-Service} (none for the default tenant) and {@code Fiware-Servicepath}
 * @param path with its query, percent-encoded, for instance {@code /v2/entities?limit=100}
 * @param body null if there is none
 * @param headers besides those of the scope, including {@code Content-Type} if there is a body
 * @param repeatable whether it is idempotent: it is then sent again when a reused connection proves dead
 */
public record BrokerRequest(
        String method, FiwareScope scope, String path, byte[] body, Map<String, String> headers, boolean repeatable) {
    private static final Map<String, String> JSON = Map.of("Content-Type", "application/json");

    public BrokerRequest {
        Objects.requireNonNull(scope);
        if (!path.startsWith("/")) {
            throw new IllegalArgumentException("a path begins with /: " + path);
        }
    }

    public static BrokerRequest get(FiwareScope scope, String path) {
        return new BrokerRequest("GET", scope, path, null, Map.of(), true);
    }

    public static BrokerRequest delete(FiwareScope scope, String path) {
        return new BrokerRequest("DELETE", scope, path, null, Map.of(), true);
    }

    public static BrokerRequest patch(FiwareScope scope, String path, JsonNode body) {
        return new BrokerRequest("PATCH", scope, path, NgsiJson.write(body), JSON, true);
    }

    /** Creates a resource: a repetition would create a second one. */
    public static BrokerRequest create(FiwareScope scope, String path, JsonNode body) {
        return new BrokerRequest("POST", scope, path, NgsiJson.write(body), JSON, false);
    }

    /** A POST that only queries, or that is idempotent. */
    public static BrokerRequest post(FiwareScope scope, String path, byte[] body) {
        return new BrokerRequest("POST", scope, path, body, JSON, true);
    }

    /** With an additional or replaced header. */
    public BrokerRequest withHeader(String name, String value) {
        Map<String, String> more = new HashMap<>(headers);
        more.put(name, value);
        return new BrokerRequest(method, scope, path, body, Map.copyOf(more), repeatable);
    }
}
