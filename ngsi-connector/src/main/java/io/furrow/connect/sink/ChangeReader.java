package io.furrow.connect.sink;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Reads an entity from what a converter made of a record's value: bytes, text, or a map of JSON values. */
final class ChangeReader {
    /** The tenants and paths that a context broker takes. */
    static final Pattern SERVICE = Pattern.compile("[a-z0-9_]{0,50}");

    static final Pattern SERVICE_PATH = Pattern.compile("/[A-Za-z0-9_/]{0,600}");

    private ChangeReader() {}

    /** @throws UnreadableException if the value is no entity in normalized form */
    static Entity entity(Object value) throws UnreadableException {
        return Entity.of(json(value));
    }

    /** @throws UnreadableException if no context broker can have such a tenant or path */
    static FiwareScope scope(String service, String servicePath) throws UnreadableException {
        FiwareScope scope = FiwareScope.of(service, servicePath);
        if (!SERVICE.matcher(scope.service()).matches()
                || !SERVICE_PATH.matcher(scope.servicePath()).matches()) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "fiware-service or fiware-servicepath is malformed");
        }
        return scope;
    }

    private static JsonNode json(Object value) throws UnreadableException {
        if (value instanceof byte[] bytes) {
            return NgsiJson.read(bytes);
        }
        if (value instanceof ByteBuffer buffer) {
            byte[] bytes = new byte[buffer.remaining()];
            buffer.duplicate().get(bytes);
            return NgsiJson.read(bytes);
        }
        if (value instanceof String text) {
            return NgsiJson.read(text.getBytes(StandardCharsets.UTF_8));
        }
        if (value instanceof Map<?, ?> map) {
            return NgsiJson.mapper().valueToTree(map);
        }
        throw new UnreadableException(
                Reason.NOT_AN_EVENT,
                "a value of " + value.getClass() + " is no entity; use the ByteArrayConverter as value.converter");
    }
}
