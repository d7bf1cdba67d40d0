package io.furrow.fiware.agent;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Writes a device: in lists and in error messages of the agent. */
final class DeviceJson {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final String TRANSPORT = "transport";

    /** Provisioned members and their names in error messages, in the agent's order. */
    private static final Map<String, String> INTERNAL = new LinkedHashMap<>();

    static {
        INTERNAL.put("attributes", "active");
        INTERNAL.put("static_attributes", "staticAttributes");
        INTERNAL.put("lazy", "lazy");
        INTERNAL.put("commands", "commands");
        List.of("timezone", "timestamp", "endpoint").forEach(same -> INTERNAL.put(same, same));
        INTERNAL.put("internal_attributes", "internalAttributes");
        List.of("protocol", TRANSPORT).forEach(same -> INTERNAL.put(same, same));
    }

    private static final List<String> LISTED =
            List.of("timezone", "timestamp", "endpoint", "polling", "internal_attributes", "protocol", "explicitAttrs");

    private DeviceJson() {}

    /** For {@code GET /iot/devices}: without unknown members; attributes and commands have an {@code object_id}. */
    static ObjectNode listed(ProvisionedDevice device) {
        JsonNode provisioned = device.json();
        ObjectNode json = NODES.objectNode().put("device_id", device.id());
        if (!device.apikey().isEmpty()) {
            json.put("apikey", device.apikey());
        }
        json.put("service", device.scope().service())
                .put("service_path", device.scope().servicePath())
                .put("entity_name", device.entityId())
                .put("entity_type", device.entityType())
                .put(TRANSPORT, provisioned.path(TRANSPORT).asText("MQTT"));
        LISTED.stream().filter(provisioned::has).forEach(member -> json.set(member, provisioned.get(member)));
        if (provisioned.has("attributes")) {
            json.set("attributes", identified(provisioned.get("attributes")));
        }
        json.set("lazy", identified(provisioned.path("lazy")));
        json.set("commands", identified(provisioned.path("commands")));
        json.set("static_attributes", list(provisioned.path("static_attributes")));
        return json;
    }

    private static ArrayNode list(JsonNode given) {
        return given instanceof ArrayNode array ? array.deepCopy() : NODES.arrayNode();
    }

    private static ArrayNode identified(JsonNode given) {
        ArrayNode all = list(given);
        for (JsonNode one : all) {
            if (one instanceof ObjectNode object && !object.has("object_id")) {
                object.set("object_id", object.get("name"));
            }
        }
        return all;
    }

    /** For the error of a duplicate device. */
    static ObjectNode internal(ProvisionedDevice device) {
        ObjectNode json = NODES.objectNode().put("id", device.id());
        if (!device.apikey().isEmpty()) {
            json.put("apikey", device.apikey());
        }
        json.put("type", device.entityType())
                .put("name", device.entityId())
                .put("service", device.scope().service())
                .put("subservice", device.scope().servicePath());
        INTERNAL.forEach((member, name) -> {
            if (device.json().has(member)) {
                json.set(name, device.json().get(member));
            }
        });
        if (!json.has(TRANSPORT)) {
            json.put(TRANSPORT, "MQTT");
        }
        return json.putNull("internalId");
    }
}
