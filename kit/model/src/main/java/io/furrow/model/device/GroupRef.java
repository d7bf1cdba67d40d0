package io.furrow.model.device;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * References the settings of a device: those of a group in a part of its mission's device list, see {@link
 * MissionDeviceList}.
 *
 * @param part number of the part, from 0
 * @param index of the group in that part, from 0
 * @param member number of the device in that group, from 0
 * @param sequence of the part; another one has other settings
 */
public record GroupRef(int part, int index, int member, long sequence) {
    /** Returns null if the node is not such an object. */
    static GroupRef read(JsonNode json) {
        boolean complete = json.path("part").canConvertToInt()
                && json.path("index").canConvertToInt()
                && json.path("sequence").canConvertToLong();
        return complete && json.isObject()
                ? new GroupRef(
                        json.path("part").intValue(),
                        json.path("index").intValue(),
                        json.path("member").intValue(),
                        json.path("sequence").longValue())
                : null;
    }

    /** Returns the reference of another device of the group. */
    public GroupRef ofMember(int number) {
        return new GroupRef(part, index, number, sequence);
    }
}
