package io.furrow.model.control;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * An attribute of a device's entity, and the member of its MQTT messages from which the IoT Agent derives it. The
 * attributes of a device result from its type and from the member {@code attributes} of its group, a list of {@code
 * {object_id, name, type, unit}}, which overrides those of the type by name.
 *
 * @param objectId the member of a message
 * @param name of the attribute
 * @param type NGSI type of its value
 * @param unit code of UN/CEFACT Recommendation 20, such as {@code CEL}, or a spelling that {@code Quantity} knows, for
 * the metadata {@code unitCode}; null for none
 */
public record MeasuredAttribute(String objectId, String name, String type, String unit) {
    /** Maximum attributes of a group. */
    static final int MAX = 100;

    private static final String FLOAT = "Float";
    private static final String LATITUDE = "Latitude";
    private static final String LONGITUDE = "Longitude";
    /** Attribute names and types that the context broker accepts. */
    private static final Pattern NAME = Pattern.compile("[A-Za-z][A-Za-z0-9_.:-]{0,99}");

    private static final Pattern OBJECT_ID = Pattern.compile("[!-~&&[^<>\"'=;()]]{1,100}");
    /** Texts that the context broker accepts. */
    private static final Pattern UNIT = Pattern.compile("[^<>\"'=;()\\p{Cntrl}]{1,40}");

    private static final List<MeasuredAttribute> COMMON = List.of(
            of("stat", "Status", "Boolean"),
            of("time", "Time", "Integer"),
            of("lat", LATITUDE, FLOAT),
            of("lon", LONGITUDE, FLOAT),
            of("where", "Location", "String"),
            of("bat", "battery", FLOAT));
    private static final Map<String, List<MeasuredAttribute>> BY_TYPE = Map.of(
            "Thermometer", List.of(of("temp", "Temperature", FLOAT)),
            // The context broker rejects the = of base64 in ordinary text.
            "Camera", List.of(of("img", "Image", "TextUnrestricted")),
            "WeatherStation",
                    List.of(
                            of("temp", "Temperature", FLOAT),
                            of("hum", "Humidity", FLOAT),
                            of("press", "Pressure", FLOAT),
                            of("wind", "WindSpeed", FLOAT),
                            of("dir", "WindDirection", FLOAT),
                            of("rain", "Rain", FLOAT),
                            of("sun", "SolarRadiation", FLOAT)));

    /** Returns the attributes that only devices of a type have; empty for an unknown type. */
    public static List<MeasuredAttribute> ofType(String type) {
        return BY_TYPE.getOrDefault(type, List.of());
    }

    private static MeasuredAttribute of(String objectId, String name, String type) {
        return new MeasuredAttribute(objectId, name, type, null);
    }

    /**
     * Returns the attributes of a device: first those of its type, then those of all devices. A real device with a
     * known position does not send it, and a simulated one of a known type sends exactly the attributes of its type.
     *
     * @param named the checked member {@code attributes} of its settings
     * @param placed whether its position is known
     */
    public static List<MeasuredAttribute> of(String type, boolean simulated, JsonNode named, boolean placed) {
        Map<String, MeasuredAttribute> byName = new LinkedHashMap<>();
        List<MeasuredAttribute> ofType = ofType(type);
        ofType.forEach(each -> byName.put(each.name(), each));
        COMMON.forEach(each -> byName.put(each.name(), each));
        if (ofType.isEmpty() || !simulated) {
            named.forEach(each -> {
                MeasuredAttribute own = parse(each);
                byName.put(own.name(), own);
            });
        }
        if (placed) {
            byName.remove(LATITUDE);
            byName.remove(LONGITUDE);
        }
        return List.copyOf(byName.values());
    }

    private static MeasuredAttribute parse(JsonNode json) {
        String name = json.path("name").asText();
        return new MeasuredAttribute(
                json.path("object_id").asText(name),
                name,
                json.path("type").asText("Number"),
                json.path("unit").textValue());
    }

    /** Returns the members that groups and the IoT Agent have in common, without the unit. */
    public ObjectNode toJson() {
        return NgsiJson.object().put("object_id", objectId).put("name", name).put("type", type);
    }

    /** Checks the member {@code attributes} of a group. */
    static void check(JsonObjectReader group) throws RejectedException {
        JsonNode list = group.arrayOrNull("attributes", MAX);
        for (JsonNode each : list == null ? List.<JsonNode>of() : list) {
            MeasuredAttribute attribute = parse(each);
            boolean fits = each.isObject()
                    && NAME.matcher(attribute.name()).matches()
                    && OBJECT_ID.matcher(attribute.objectId()).matches()
                    && NAME.matcher(attribute.type()).matches()
                    && (attribute.unit() == null
                            || UNIT.matcher(attribute.unit()).matches());
            JsonObjectReader.refuseIf(
                    !fits,
                    "attributes",
                    "a list of objects with 'object_id' (the member of a message), 'name' (of the attribute), and perhaps 'type' (Number)"
                            + " and 'unit' (a code of UN/CEFACT as CEL, or a spelling as °C)");
        }
    }
}
