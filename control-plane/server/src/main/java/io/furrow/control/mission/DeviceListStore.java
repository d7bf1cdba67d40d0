package io.furrow.control.mission;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.Table;
import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.RejectedException;
import io.furrow.model.device.GroupRef;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * Stores the device lists of missions in parts as requested, and publishes them on {@code service.missions.devices}.
 *
 * @param parts records of the topic by their keys
 */
record DeviceListStore(Table<byte[]> parts, Sequence sequence, Quota quota, EventPublisher publisher) {
    MissionDevices of(Mission mission) {
        ArrayNode all = NgsiJson.array();
        for (MissionDeviceList part : parts(mission)) {
            all.addAll(part.devices());
        }
        return MissionDevices.of(all);
    }

    /** Returns its groups in the order of the list. */
    List<ListedGroup> groups(Mission mission) {
        List<GroupRef> refs = new ArrayList<>();
        for (MissionDeviceList part : parts(mission)) {
            for (int index = 0; index < part.devices().size(); index++) {
                refs.add(new GroupRef(part.part(), index, 0, part.sequence()));
            }
        }
        List<DeviceGroup> groups = of(mission).groups();
        List<ListedGroup> listed = new ArrayList<>();
        for (int i = 0; i < groups.size(); i++) {
            listed.add(new ListedGroup(groups.get(i), refs.get(i)));
        }
        return listed;
    }

    /**
     * Replaces the device list of a mission.
     *
     * @return the mission with the new list
     */
    Mission replace(Mission mission, MissionDevices devices) throws RejectedException {
        for (int part = 1; part < mission.parts(); part++) {
            remove(mission, part);
        }
        if (devices.groups().isEmpty()) {
            remove(mission, 0);
            return mission.listing(0, 0);
        }
        put(mission, 0, devices);
        return mission.listing(1, devices.count());
    }

    /**
     * Appends to the device list of a mission.
     *
     * @return the mission with the new list
     */
    Mission append(Mission mission, MissionDevices more) throws RejectedException {
        if (more.groups().isEmpty()) {
            return mission;
        }
        MissionDevices all = of(mission).plus(more);
        put(mission, mission.parts(), more);
        Mission after = mission.listing(mission.parts() + 1, all.count());
        int bytes = 0;
        for (int part = 0; part < after.parts(); part++) {
            bytes += parts.get(MissionDeviceList.key(mission.mission(), part)).length;
        }
        if (bytes > Limits.MISSION_BYTES) {
            throw new RejectedException(
                    ErrorCode.TOO_LARGE,
                    "the devices of mission '%s' would have %d bytes, and may have %d"
                            .formatted(mission.mission(), bytes, Limits.MISSION_BYTES));
        }
        return after;
    }

    void forget(Mission mission) {
        for (int part = 0; part < mission.parts(); part++) {
            remove(mission, part);
        }
    }

    private void put(Mission mission, int part, MissionDevices devices) throws RejectedException {
        MissionDeviceList list = new MissionDeviceList(mission.mission(), part, sequence.next(), devices.toJson());
        byte[] value = list.toBytes();
        long further = cost(value) - cost(parts.get(list.key()));
        quota.require(further);
        quota.use(further);
        parts.put(list.key(), value);
        publisher.put(Topics.MISSION_DEVICES, list.key(), value);
    }

    private void remove(Mission mission, int part) {
        String key = MissionDeviceList.key(mission.mission(), part);
        byte[] existing = parts.get(key);
        if (existing != null) {
            quota.use(-cost(existing));
            parts.put(key, null);
            publisher.put(Topics.MISSION_DEVICES, key, null);
        }
    }

    /** Returns the quota that a part uses: its bytes and the settings of its devices; 0 for null. */
    private static long cost(byte[] part) {
        return part == null
                ? 0
                : part.length + MissionDevices.ofPart(read(part).devices()).settingsBytes();
    }

    private List<MissionDeviceList> parts(Mission mission) {
        List<MissionDeviceList> all = new ArrayList<>();
        for (int part = 0; part < mission.parts(); part++) {
            all.add(read(parts.get(MissionDeviceList.key(mission.mission(), part))));
        }
        return all;
    }

    private static MissionDeviceList read(byte[] value) {
        return NgsiJson.own(() -> MissionDeviceList.read(value));
    }
}
