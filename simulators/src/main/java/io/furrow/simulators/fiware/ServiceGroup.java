package io.furrow.simulators.fiware;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;

/**
 * A service group: the API key that devices share, and what they have in common.
 *
 * @param resource the agent's path, part of the group's identity
 * @param json as it was provisioned
 */
record ServiceGroup(
        FiwareScope scope, String apikey, String resource, String entityType, DeviceMapping mapping, ObjectNode json) {
    static ServiceGroup read(FiwareScope scope, JsonNode json) throws NgsiError {
        if (!json.path("apikey").isTextual() || !json.isObject()) {
            throw new NgsiError(400, "WRONG_SYNTAX", "Wrong syntax in request: a service needs an apikey");
        }
        String type = json.path("entity_type").asText(json.path("type").asText(EntityUpdate.DEFAULT_TYPE));
        return new ServiceGroup(
                scope,
                json.get("apikey").textValue(),
                json.path("resource").asText(""),
                type,
                DeviceMapping.read(json),
                json.deepCopy());
    }

    /** Whether a device that is not provisioned becomes one with its first measure. */
    boolean takesUnprovisioned() {
        return json.path("autoprovision").asBoolean(true);
    }
}
