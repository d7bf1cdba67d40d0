package io.furrow.fiware.agent;

import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;

/**
 * A service group: an API key and the common settings of its devices.
 *
 * @param json as provisioned, with the number and date of the registry
 */
public record ServiceGroup(FiwareScope scope, Key key, String entityType, DeviceMapping mapping, ObjectNode json) {
    private static final Map<String, String> INTERNAL = Map.of(
            "entity_type", "type",
            "static_attributes", "staticAttributes",
            "internal_attributes", "internalAttributes");

    /**
     * Key of a group, unique across tenants.
     *
     * @param resource path of the agent
     */
    record Key(String resource, String apikey) {}

    public static ServiceGroup read(FiwareScope scope, JsonNode json) throws NgsiError {
        if (!json.path("apikey").isTextual()) {
            throw AgentErrors.wrongSyntax();
        }
        String type = json.path("entity_type").asText(json.path("type").asText(EntityUpdate.DEFAULT_TYPE));
        return new ServiceGroup(
                scope,
                new Key(json.path("resource").asText(""), json.get("apikey").textValue()),
                type,
                DeviceMapping.read(json),
                members(json));
    }

    static ObjectNode members(JsonNode json) throws NgsiError {
        if (json instanceof ObjectNode object) {
            return object.deepCopy();
        }
        throw AgentErrors.wrongSyntax();
    }

    String apikey() {
        return key.apikey();
    }

    String resource() {
        return key.resource();
    }

    /** Whether an unprovisioned device is registered by its first measure. */
    boolean takesUnprovisioned() {
        return json.path("autoprovision").asBoolean(true);
    }

    /** Adds a number and a date, unless present. */
    ServiceGroup registered(int number, long now) {
        ObjectNode registered = json.deepCopy();
        if (!json.has("_id")) {
            registered.put("_id", number).put("creationDate", now);
        }
        return new ServiceGroup(scope, key, entityType, mapping, registered);
    }

    /** Changes members; scope and key stay. */
    ServiceGroup changed(ObjectNode change) throws NgsiError {
        ObjectNode changed = json.deepCopy();
        changed.setAll(change);
        changed.put("resource", resource()).put("apikey", apikey());
        return read(scope, changed);
    }

    /** JSON for {@code GET /iot/services}. */
    ObjectNode listed() {
        ObjectNode listed = json.deepCopy().put("service", scope.service()).put("subservice", scope.servicePath());
        if (listed.has("type")) {
            listed.set("entity_type", listed.remove("type"));
        }
        return listed;
    }

    /** JSON for the agent's error messages: renamed members come last. */
    ObjectNode internal() {
        ObjectNode internal = JsonNodeFactory.instance.objectNode();
        ObjectNode renamed = JsonNodeFactory.instance.objectNode();
        json.properties().forEach(member -> {
            String name = INTERNAL.get(member.getKey());
            if (name == null) {
                internal.set(member.getKey(), member.getValue());
            } else {
                renamed.set(name, member.getValue());
            }
        });
        internal.setAll(renamed);
        return internal.put("service", scope.service()).put("subservice", scope.servicePath());
    }
}
