package io.furrow.fiware.agent;

import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.AttributeInput;
import io.furrow.fiware.broker.EntityUpdate;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.http.NgsiError;
import io.furrow.model.event.FiwareScope;

/**
 * A device and its entity.
 *
 * @param group of the device when it was provisioned
 * @param mapping of the device over that of its group
 * @param json as provisioned
 */
public record ProvisionedDevice(
        FiwareScope scope,
        String id,
        String apikey,
        String entityId,
        String entityType,
        Optional<ServiceGroup> group,
        DeviceMapping mapping,
        ObjectNode json) {
    /** @param group of its scope, if any: provides defaults */
    public static ProvisionedDevice read(FiwareScope scope, JsonNode json, Optional<ServiceGroup> group)
            throws NgsiError {
        if (!json.path("device_id").isTextual()) {
            throw AgentErrors.missingAttributes(json);
        }
        String id = json.get("device_id").textValue();
        String type = json.path("entity_type")
                .asText(group.map(ServiceGroup::entityType).orElse(EntityUpdate.DEFAULT_TYPE));
        DeviceMapping own = DeviceMapping.read(json);
        String entityId = json.path("entity_name").asText(type + ":" + id);
        SyntaxRules.checkEntity(entityId, Optional.of(type));
        return new ProvisionedDevice(
                scope,
                id,
                json.path("apikey").asText(group.map(ServiceGroup::apikey).orElse("")),
                entityId,
                type,
                group,
                group.map(of -> own.over(of.mapping())).orElse(own),
                json.deepCopy());
    }

    /** An unprovisioned device with a known API key. */
    static ProvisionedDevice unprovisioned(ServiceGroup group, String id) throws NgsiError {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("device_id", id);
        return read(group.scope(), json, Optional.of(group));
    }

    EntityUpdate update(Map<String, AttributeInput> attributes) {
        return new EntityUpdate(entityId, Optional.of(entityType), attributes);
    }
}
