package io.furrow.provisioner;

import java.util.LinkedHashSet;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The registration of a device at the IoT Agent, actual or desired; two are equal if devices need not be provisioned
 * again.
 *
 * @param device id at the agent, second part of its MQTT topics
 * @param apiKey of its mission, first part of its MQTT topics
 * @param entity id of the entity that carries its measures
 * @param type of that entity
 * @param attributes how members of a measure become attributes
 * @param domain static attribute {@code Domain}; null if it has none
 * @param mission static attribute {@code Mission}; null if it has none
 * @param commands the commands that it accepts
 */
record Registration(
        String device,
        String apiKey,
        String entity,
        String type,
        Set<Attribute> attributes,
        String domain,
        String mission,
        Set<String> commands) {
    private static final String DOMAIN = "Domain";
    private static final String MISSION = "Mission";

    /** Member {@code objectId} of a measure becomes the attribute {@code name} of NGSI type {@code type}. */
    record Attribute(String objectId, String name, String type) {}

    /** As the agent shows it; what we never set is skipped. */
    static Registration read(JsonNode json) {
        Set<Attribute> attributes = new LinkedHashSet<>();
        for (JsonNode each : json.path("attributes")) {
            attributes.add(new Attribute(
                    each.path("object_id").asText(),
                    each.path("name").asText(),
                    each.path("type").asText()));
        }
        Set<String> commands = new LinkedHashSet<>();
        json.path("commands")
                .forEach(command -> commands.add(command.path("name").asText()));
        return new Registration(
                json.path("device_id").asText(),
                json.path("apikey").asText(),
                json.path("entity_name").asText(),
                json.path("entity_type").asText(),
                attributes,
                fixed(json, DOMAIN),
                mission(json),
                commands);
    }

    /** The mission that a device or a service group belongs to, as the agent shows it; null if it says none. */
    static String mission(JsonNode json) {
        return fixed(json, MISSION);
    }

    private static String fixed(JsonNode json, String name) {
        for (JsonNode each : json.path("static_attributes")) {
            if (name.equals(each.path("name").textValue())) {
                return each.path("value").textValue();
            }
        }
        return null;
    }

    ObjectNode toJson() {
        ObjectNode json = JsonNodeFactory.instance
                .objectNode()
                .put("device_id", device)
                .put("apikey", apiKey)
                .put("entity_name", entity)
                .put("entity_type", type)
                .put("transport", "MQTT");
        ArrayNode mapped = json.putArray("attributes");
        attributes.forEach(attribute -> mapped.addObject()
                .put("object_id", attribute.objectId())
                .put("name", attribute.name())
                .put("type", attribute.type()));
        fix(json, domain, mission);
        ArrayNode orders = json.putArray("commands");
        commands.forEach(name -> orders.addObject().put("name", name).put("type", "command"));
        return json;
    }

    /** Adds the attributes that every measure gets. */
    static void fix(ObjectNode json, String domain, String mission) {
        ArrayNode fixed = json.putArray("static_attributes");
        fixed.addObject().put("name", DOMAIN).put("type", "String").put("value", domain);
        fixed.addObject().put("name", MISSION).put("type", "String").put("value", mission);
    }
}
