package io.furrow.connect.broker;

import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/**
 * One request.
 *
 * @param scope sent as {@code Fiware-Service} (none for the default tenant) and {@code Fiware-Servicepath}
 * @param path with its query, percent-encoded, for instance {@code /v2/entities?limit=100}
 * @param body null where there is none
 * @param contentType of the body
 * @param repeatable whether a second time does no harm: it is then sent again when a kept connection proves dead
 */
public record BrokerRequest(
        String method, FiwareScope scope, String path, byte[] body, String contentType, boolean repeatable) {
    private static final String JSON = "application/json";

    public BrokerRequest {
        Objects.requireNonNull(scope);
        if (!path.startsWith("/")) {
            throw new IllegalArgumentException("a path begins with /: " + path);
        }
    }

    public static BrokerRequest get(FiwareScope scope, String path) {
        return new BrokerRequest("GET", scope, path, null, JSON, true);
    }

    public static BrokerRequest delete(FiwareScope scope, String path) {
        return new BrokerRequest("DELETE", scope, path, null, JSON, true);
    }

    public static BrokerRequest patch(FiwareScope scope, String path, JsonNode body) {
        return new BrokerRequest("PATCH", scope, path, NgsiJson.write(body), JSON, true);
    }

    /** Creates something: a second time would create a second one. */
    public static BrokerRequest create(FiwareScope scope, String path, JsonNode body) {
        return new BrokerRequest("POST", scope, path, NgsiJson.write(body), JSON, false);
    }

    /** A POST that only asks, or that leaves the same state when it is done twice. */
    public static BrokerRequest post(FiwareScope scope, String path, byte[] body) {
        return new BrokerRequest("POST", scope, path, body, JSON, true);
    }

    public BrokerRequest withContentType(String other) {
        return new BrokerRequest(method, scope, path, body, other, repeatable);
    }
}
