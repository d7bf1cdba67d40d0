package io.furrow.provisioner;

import java.util.LinkedHashSet;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.MeasuredAttribute;
import io.furrow.model.ngsi.NgsiJson;

/**
 * The registration of a device at the IoT Agent, actual or desired; a device is provisioned again unless the two are
 * equal.
 *
 * @param device id at the agent, second part of its MQTT topics
 * @param apiKey of its mission, first part of its MQTT topics
 * @param entity id of the entity that carries its measures
 * @param type of that entity
 * @param attributes how members of a measure become attributes
 * @param fixed its static attributes
 * @param commands the commands that it accepts
 */
record AgentRegistration(
        String device,
        String apiKey,
        String entity,
        String type,
        Set<MeasuredAttribute> attributes,
        StaticAttribute fixed,
        Set<String> commands) {
    private static final String DOMAIN = "Domain";
    private static final String MISSION = "Mission";
    private static final String LATITUDE = "Latitude";
    private static final String LONGITUDE = "Longitude";

    /**
     * Static attributes, which every measure gets.
     *
     * @param domain {@code Domain}; null if it has none
     * @param mission {@code Mission}; null if it has none
     * @param place null if it has none
     */
    record StaticAttribute(String domain, String mission, Place place) {}

    /** {@code Latitude} and {@code Longitude}, degrees. */
    record Place(double latitude, double longitude) {}

    String domain() {
        return fixed.domain();
    }

    String mission() {
        return fixed.mission();
    }

    /** Parses the agent's representation; members that the provisioner never sets are ignored. */
    static AgentRegistration read(JsonNode json) {
        Set<MeasuredAttribute> attributes = new LinkedHashSet<>();
        for (JsonNode each : json.path("attributes")) {
            attributes.add(new MeasuredAttribute(
                    each.path("object_id").asText(),
                    each.path("name").asText(),
                    each.path("type").asText(),
                    each.at("/metadata/unitCode/value").textValue()));
        }
        Set<String> commands = new LinkedHashSet<>();
        json.path("commands")
                .forEach(command -> commands.add(command.path("name").asText()));
        return new AgentRegistration(
                json.path("device_id").asText(),
                json.path("apikey").asText(),
                json.path("entity_name").asText(),
                json.path("entity_type").asText(),
                attributes,
                new StaticAttribute(fixed(json, DOMAIN).textValue(), mission(json), place(json)),
                commands);
    }

    /** Returns the mission of a device or service group in the agent's representation; null if it has none. */
    static String mission(JsonNode json) {
        return fixed(json, MISSION).textValue();
    }

    private static Place place(JsonNode json) {
        JsonNode latitude = fixed(json, LATITUDE);
        JsonNode longitude = fixed(json, LONGITUDE);
        return latitude.isNumber() && longitude.isNumber()
                ? new Place(latitude.doubleValue(), longitude.doubleValue())
                : null;
    }

    private static JsonNode fixed(JsonNode json, String name) {
        for (JsonNode each : json.path("static_attributes")) {
            if (name.equals(each.path("name").textValue())) {
                return each.path("value");
            }
        }
        return MissingNode.getInstance();
    }

    ObjectNode toJson() {
        ObjectNode json = NgsiJson.object()
                .put("device_id", device)
                .put("apikey", apiKey)
                .put("entity_name", entity)
                .put("entity_type", type)
                .put("transport", "MQTT");
        ArrayNode mapped = json.putArray("attributes");
        attributes.forEach(attribute -> {
            ObjectNode mapping = attribute.toJson();
            if (attribute.unit() != null) {
                mapping.putObject("metadata")
                        .putObject("unitCode")
                        .put("type", "Text")
                        .put("value", attribute.unit());
            }
            mapped.add(mapping);
        });
        fix(json, fixed);
        ArrayNode orders = json.putArray("commands");
        commands.forEach(name -> orders.addObject().put("name", name).put("type", "command"));
        return json;
    }

    /** Adds the static attributes. */
    static void fix(ObjectNode json, StaticAttribute fixed) {
        ArrayNode all = json.putArray("static_attributes");
        all.addObject().put("name", DOMAIN).put("type", "String").put("value", fixed.domain());
        all.addObject().put("name", MISSION).put("type", "String").put("value", fixed.mission());
        if (fixed.place() != null) {
            all.addObject()
                    .put("name", LATITUDE)
                    .put("type", "Float")
                    .put("value", fixed.place().latitude());
            all.addObject()
                    .put("name", LONGITUDE)
                    .put("type", "Float")
                    .put("value", fixed.place().longitude());
        }
    }
}
