package io.furrow.model.control;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.annotation.JsonValue;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * The devices of a mission or a template, by group. Names are unique, carriers exist, and no group carries itself.
 *
 * @param groups at most {@value DeviceGroup#MAX} devices in total
 */
public record MissionDevices(List<DeviceGroup> groups) {
    /** No listed devices: devices that report the mission's name belong to it. */
    public static final MissionDevices NONE = new MissionDevices(List.of());

    public MissionDevices {
        groups = List.copyOf(groups);
    }

    /** Returns the number of devices, including those that are not provisioned. */
    public int count() {
        return groups.stream().mapToInt(DeviceGroup::count).sum();
    }

    /**
     * Reads the result of {@link #toJson()}.
     *
     * @throws IllegalArgumentException if it is invalid
     */
    public static MissionDevices of(ArrayNode json) {
        try {
            return read(new JsonObjectReader(NgsiJson.object().set("devices", json)));
        } catch (RejectedException e) {
            throw new IllegalArgumentException("invalid devices of a mission: " + e.getMessage(), e);
        }
    }

    /** Reads a part of a list from {@link #toJson()}; names and carriers are checked with the whole list. */
    public static MissionDevices ofPart(ArrayNode json) {
        try {
            return readPart(new JsonObjectReader(NgsiJson.object().set("devices", json)));
        } catch (RejectedException e) {
            throw new IllegalArgumentException("invalid devices of a mission: " + e.getMessage(), e);
        }
    }

    /** Reads the member {@code devices} of a request or a template. */
    static MissionDevices read(JsonObjectReader members) throws RejectedException {
        return readPart(members).checked();
    }

    /** Reads the devices of a request that adds to a list; names and carriers are checked with the whole list. */
    static MissionDevices readPart(JsonObjectReader members) throws RejectedException {
        ArrayNode array = members.arrayOrNull("devices", DeviceGroup.MAX);
        List<DeviceGroup> groups = new ArrayList<>();
        long count = 0;
        for (JsonNode each : array == null ? List.<JsonNode>of() : array) {
            groups.add(DeviceGroup.read(each));
            count += groups.get(groups.size() - 1).count();
        }
        if (count > DeviceGroup.MAX) {
            throw tooMany();
        }
        return new MissionDevices(groups);
    }

    private static RejectedException tooMany() {
        return JsonObjectReader.wrong("devices", "at most " + DeviceGroup.MAX + " devices in all");
    }

    /**
     * Returns these devices followed by others.
     *
     * @throws RejectedException if they do not fit together or are too many
     */
    public MissionDevices plus(MissionDevices others) throws RejectedException {
        List<DeviceGroup> all = new ArrayList<>(groups);
        all.addAll(others.groups);
        MissionDevices devices = new MissionDevices(all).checked();
        if (devices.count() > DeviceGroup.MAX) {
            throw tooMany();
        }
        return devices;
    }

    /**
     * Returns the bytes of the settings of all devices except areas. This exceeds the size here because devices of a
     * group share settings.
     */
    public long settingsBytes() {
        return groups.stream().mapToLong(DeviceGroup::settingsBytes).sum();
    }

    private MissionDevices checked() throws RejectedException {
        if (settingsBytes() > Limits.MISSION_BYTES) {
            throw new RejectedException(
                    ErrorCode.TOO_LARGE,
                    "'path', 'faults' and 'parameters' of all devices together may have %d bytes, and have %d; give less to so many"
                            .formatted(Limits.MISSION_BYTES, settingsBytes()));
        }
        Map<String, DeviceGroup> named = new HashMap<>();
        Set<String> ids = new HashSet<>();
        for (DeviceGroup group : groups) {
            boolean isDuplicate = group.label() != null && named.put(group.label(), group) != null;
            JsonObjectReader.refuseIf(
                    isDuplicate || group.id() != null && !ids.add(group.id()),
                    "devices",
                    "a list in which no name and no id comes twice");
        }
        for (DeviceGroup group : groups) {
            Set<String> seen = new HashSet<>();
            for (DeviceGroup at = group; at != null && at.carriedBy() != null; at = named.get(at.carriedBy())) {
                JsonObjectReader.refuseIf(
                        !named.containsKey(at.carriedBy()) || !seen.add(at.carriedBy()),
                        "carriedBy",
                        "the name of another group of the list, and not in a circle");
            }
        }
        return this;
    }

    /** Checks the areas of a request; stored lists may be older than this check. */
    MissionDevices withValidAreas() throws RejectedException {
        for (int group = 0; group < groups.size(); group++) {
            JsonNode area = groups.get(group).settings().path("area");
            if (area.isObject()) {
                JsonObjectReader.checkArea(area, "'area' of devices[" + group + "]");
            }
        }
        return this;
    }

    /** Returns the member {@code devices}. */
    @JsonValue
    public ArrayNode toJson() {
        ArrayNode array = NgsiJson.array();
        groups.forEach(group -> array.add(group.toJson()));
        return array;
    }
}
