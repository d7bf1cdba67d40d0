package io.furrow.simulators.device;

import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Describes a device to the IoT Agent.
 *
 * @param id device id, second part of its MQTT topics
 * @param entity entity that carries its measures
 * @param attributes how members of a measure become attributes
 * @param mission attributes added to every measure
 * @param commands accepted commands
 */
public record DeviceRegistration(
        String id, Entity entity, List<Attribute> attributes, MissionOf mission, List<String> commands) {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    public record Entity(String id, String type) {}

    /** Member {@code objectId} of a measure becomes the attribute {@code name} of NGSI type {@code type}. */
    public record Attribute(String objectId, String name, String type) {}

    public record MissionOf(String domain, String mission) {}

    ObjectNode toJson(String apiKey) {
        ObjectNode json = NODES.objectNode()
                .put("device_id", id)
                .put("apikey", apiKey)
                .put("entity_name", entity.id())
                .put("entity_type", entity.type())
                .put("transport", "MQTT");
        ArrayNode mapped = json.putArray("attributes");
        attributes.forEach(attribute -> mapped.addObject()
                .put("object_id", attribute.objectId())
                .put("name", attribute.name())
                .put("type", attribute.type()));
        ArrayNode fixed = json.putArray("static_attributes");
        fixed.addObject().put("name", "Domain").put("type", "String").put("value", mission.domain());
        fixed.addObject().put("name", "Mission").put("type", "String").put("value", mission.mission());
        ArrayNode orders = json.putArray("commands");
        commands.forEach(name -> orders.addObject().put("name", name).put("type", "command"));
        return json;
    }
}
