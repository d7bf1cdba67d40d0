package io.furrow.model.control;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

/**
 * The devices of a mission or of a template, group by group. Names are unique, what carries is there, nothing carries itself.
 *
 * @param groups at most {@value DeviceGroup#MOST} devices in all
 */
public record MissionDevices(List<DeviceGroup> groups) {
    /** No devices of its own: what reports with the mission's name belongs to it. */
    public static final MissionDevices NONE = new MissionDevices(List.of());

    public MissionDevices {
        groups = List.copyOf(groups);
    }

    /** How many devices there are, those that report by themselves too. */
    public int count() {
        return groups.stream().mapToInt(DeviceGroup::count).sum();
    }

    /** The member {@code devices} of a request or a template. */
    static MissionDevices read(Members members) throws RefusedException {
        ArrayNode array = members.arrayOrNull("devices", DeviceGroup.MOST);
        List<DeviceGroup> groups = new ArrayList<>();
        long count = 0;
        for (JsonNode each : array == null ? List.<JsonNode>of() : array) {
            groups.add(DeviceGroup.read(each));
            count += groups.get(groups.size() - 1).count();
        }
        if (count > DeviceGroup.MOST) {
            throw Members.wrong("devices", "at most " + DeviceGroup.MOST + " devices in all");
        }
        MissionDevices devices = new MissionDevices(groups);
        devices.checkCarriers();
        return devices;
    }

    private void checkCarriers() throws RefusedException {
        Map<String, DeviceGroup> named = new HashMap<>();
        Set<String> ids = new HashSet<>();
        for (DeviceGroup group : groups) {
            boolean known = group.label() != null && named.put(group.label(), group) != null;
            if (known || group.id() != null && !ids.add(group.id())) {
                throw Members.wrong("devices", "a list in which no name and no id comes twice");
            }
        }
        for (DeviceGroup group : groups) {
            Set<String> seen = new HashSet<>();
            for (DeviceGroup at = group; at != null && at.carriedBy() != null; at = named.get(at.carriedBy())) {
                if (!named.containsKey(at.carriedBy()) || !seen.add(at.carriedBy())) {
                    throw Members.wrong("carriedBy", "the name of another group of the list, and not in a circle");
                }
            }
        }
    }

    /** As {@code devices} has it. */
    public ArrayNode toJson() {
        ArrayNode array = JsonNodeFactory.instance.arrayNode();
        groups.forEach(group -> array.add(group.toJson()));
        return array;
    }
}
