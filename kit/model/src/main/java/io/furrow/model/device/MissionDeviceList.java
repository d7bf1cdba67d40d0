package io.furrow.model.device;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A part of a mission's device list: a record of {@code service.missions.devices} under {@link #key()}. The devices of
 * one request are one part, so that no record grows with the mission.
 *
 * @param part from 0
 * @param sequence grows with every change of any desired state
 * @param devices groups and entity ids as in requests; owned by the list, not to be changed by readers
 */
public record MissionDeviceList(String mission, int part, long sequence, ArrayNode devices) implements StateRecord {
    /** Returns {@code <mission>.<part>}. */
    public String key() {
        return key(mission, part);
    }

    public static String key(String mission, int part) {
        return mission + "." + part;
    }

    /**
     * Reads the value of a record.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object
     */
    public static MissionDeviceList read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        if (!json.path("mission").isTextual()
                || !json.path("part").canConvertToInt()
                || !json.path("sequence").canConvertToLong()
                || !(json.path("devices") instanceof ArrayNode devices)) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT, "it is not an object with 'mission', 'part', 'sequence' and 'devices'");
        }
        return new MissionDeviceList(
                json.path("mission").textValue(),
                json.path("part").intValue(),
                json.path("sequence").longValue(),
                devices);
    }

    /** Returns the settings of a device, with its own {@code at}; empty if there is no such group. */
    ObjectNode settings(GroupRef ref) {
        ObjectNode settings =
                devices.get(ref.index()) instanceof ObjectNode group ? DeviceGroup.settings(group) : NgsiJson.object();
        if (settings.path("at").isArray()) {
            settings.set("at", settings.path("at").path(ref.member()));
        }
        return settings;
    }
}
