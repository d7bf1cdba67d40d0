package io.furrow.model.control;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Set;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Devices of one kind on a mission, an element of {@code devices}. A text is the id of an entity with credentials of
 * its own, which is assigned to the mission but not provisioned.
 *
 * @param name used by {@code carriedBy} of other groups; null if not needed
 * @param id of the entity of a single device; null to derive ids from the mission's name
 * @param type of the entities; null if the device is not provisioned
 * @param count number of devices, 1 to {@value #MAX}
 * @param carriedBy name of the group whose devices carry these, in turn; null if none does
 * @param period between two measures; null if unknown
 * @param simulated whether a host of simulated devices runs them; null for the default of the control plane
 * @param settings {@code area} (id of a field or GeoJSON), {@code path} (list of [longitude, latitude]), {@code speed}
 * (m/s), {@code faults} (objects with {@code kind} stuck, drift, spikes or silent), {@code parameters} (anything the
 * host understands), {@code attributes} (see {@link MeasuredAttribute}) and {@code at} ({@code {latitude, longitude}},
 * or one for each device), as in the request; owned by the group, not to be changed by readers
 */
public record DeviceGroup(
        String name,
        String id,
        String type,
        int count,
        String carriedBy,
        Duration period,
        Boolean simulated,
        ObjectNode settings) {
    /** Maximum devices of a mission. */
    public static final int MAX = 10_000;

    /** Entity ids that the context broker accepts, with room for a prefix. */
    static final Pattern ENTITY_ID = Pattern.compile("[!-~&&[^&?/#<>\"'=;()|%]]{1,200}");

    private static final String AT = "at";
    private static final Pattern TYPE = Pattern.compile("[A-Za-z][A-Za-z0-9]{0,63}");
    private static final Set<String> AREAS = Set.of("Polygon", "MultiPolygon");
    private static final Set<String> FAULTS = Set.of("stuck", "drift", "spikes", "silent");
    private static final List<String> SETTINGS =
            List.of("area", "path", "speed", "faults", "parameters", "attributes", AT);
    private static final double MAX_SPEED = 100;

    /** Returns an entity with credentials of its own. */
    public static DeviceGroup entity(String id) {
        return new DeviceGroup(null, id, null, 1, null, null, null, NgsiJson.object());
    }

    /** Returns the value of {@code carriedBy} that refers to this group; null if there is none. */
    public String label() {
        return name == null ? id : name;
    }

    static DeviceGroup read(JsonNode json) throws RejectedException {
        if (json.isTextual()) {
            return entity(entityId(json.textValue()));
        }
        if (!(json instanceof ObjectNode object)) {
            throw JsonObjectReader.wrong("devices", "a list of objects and entity ids");
        }
        JsonObjectReader members = new JsonObjectReader(object);
        String id = members.has("id") ? entityId(members.text("id")) : null;
        String type = members.text("type");
        JsonObjectReader.refuseIf(
                !TYPE.matcher(type).matches(), "type", "1 to 64 letters and digits that begin with a letter");
        int count = members.wholeNumber("count", 1, MAX, 1);
        JsonObjectReader.refuseIf(id != null && count > 1, "count", "1 where the device has an 'id'");
        check(members);
        MeasuredAttribute.check(members);
        checkPositions(object.path(AT), count);
        ObjectNode settings = settings(object);
        return new DeviceGroup(
                members.nameOrNull("name"),
                id,
                type,
                count,
                members.textOrNull("carriedBy"),
                members.durationOrNull("period"),
                members.has("simulated") ? members.flag("simulated") : null,
                settings);
    }

    /** Returns the settings of a group of a request, without nulls. */
    public static ObjectNode settings(ObjectNode group) {
        ObjectNode settings = NgsiJson.object();
        for (String name : SETTINGS) {
            if (group.hasNonNull(name)) {
                settings.set(name, group.get(name));
            }
        }
        return settings;
    }

    /** Returns the bytes of the settings of all devices, except the area, which they share. */
    long settingsBytes() {
        ObjectNode own = NgsiJson.object();
        own.setAll(settings);
        own.remove(List.of("area", AT));
        return own.isEmpty() ? 0 : (long) count * NgsiJson.write(own).length;
    }

    private static String entityId(String id) throws RejectedException {
        JsonObjectReader.refuseIf(
                !ENTITY_ID.matcher(id).matches(), "id", "1 to 200 characters that are allowed in an entity id");
        return id;
    }

    private static void check(JsonObjectReader members) throws RejectedException {
        members.numberOrNull("speed", 0, MAX_SPEED);
        members.objectOrNull("parameters");
        JsonNode area = members.json().path("area");
        boolean field = area.isTextual() && ENTITY_ID.matcher(area.textValue()).matches();
        JsonObjectReader.refuseIf(
                members.has("area") && !field && !isArea(area),
                "area",
                "the id of a field, or a GeoJSON Polygon or MultiPolygon");
        ArrayNode path = members.arrayOrNull("path", MAX);
        for (JsonNode point : path == null ? List.<JsonNode>of() : path) {
            JsonObjectReader.refuseIf(
                    point.size() != 2 || !isDegrees(point.get(0), 180) || !isDegrees(point.get(1), 90),
                    "path",
                    "a list of [longitude, latitude]");
        }
        ArrayNode faults = members.arrayOrNull("faults", MAX);
        for (JsonNode fault : faults == null ? List.<JsonNode>of() : faults) {
            JsonObjectReader.refuseIf(
                    !FAULTS.contains(fault.path("kind").asText()),
                    "faults",
                    "a list of objects with 'kind' stuck, drift, spikes or silent");
        }
    }

    private static void checkPositions(JsonNode at, int count) throws RejectedException {
        boolean fits = at.isMissingNode() || at.isNull() || isPosition(at);
        if (at.isArray() && at.size() == count) {
            fits = true;
            for (JsonNode each : at) {
                fits &= isPosition(each);
            }
        }
        JsonObjectReader.refuseIf(
                !fits,
                AT,
                "an object with 'latitude' and 'longitude' in degrees, or a list of one for each of the devices");
    }

    private static boolean isPosition(JsonNode at) {
        return at.isObject() && isDegrees(at.get("latitude"), 90) && isDegrees(at.get("longitude"), 180);
    }

    private static boolean isDegrees(JsonNode value, double max) {
        return value != null && value.isNumber() && Math.abs(value.doubleValue()) <= max;
    }

    private static boolean isArea(JsonNode area) {
        return AREAS.contains(area.path("type").asText())
                && area.path("coordinates").isArray();
    }

    JsonNode toJson() {
        if (type == null) {
            return JsonNodeFactory.instance.textNode(id);
        }
        ObjectNode json = NgsiJson.object();
        put(json, "name", name);
        put(json, "id", id);
        json.put("type", type).put("count", count);
        put(json, "carriedBy", carriedBy);
        put(json, "period", period == null ? null : period.toString());
        if (simulated != null) {
            json.put("simulated", simulated);
        }
        json.setAll(settings);
        return json;
    }

    /** Puts a member unless it is null. */
    static void put(ObjectNode json, String member, String value) {
        if (value != null) {
            json.put(member, value);
        }
    }

    static void put(ObjectNode json, String member, Instant time) {
        put(json, member, time == null ? null : time.toString());
    }
}
