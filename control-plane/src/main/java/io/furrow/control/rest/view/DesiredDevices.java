package io.furrow.control.rest.view;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads desired devices with the settings of their groups. */
public final class DesiredDevices {
    private final ServiceView view;

    public DesiredDevices(ServiceView view) {
        this.view = view;
    }

    /** @param identity tenant, service path and id of the entity */
    public Optional<WantedDevice> find(String identity) {
        return view.find(Topics.DEVICES, identity).flatMap(device -> read(device, new MissionDeviceLists()));
    }

    /** Those of a mission that shall run. */
    public List<WantedDevice> of(String mission) {
        MissionDeviceLists lists = new MissionDeviceLists();
        int parts = view.find(Topics.MISSIONS, mission)
                .map(found -> found.path("parts").asInt())
                .orElse(0);
        for (int part = 0; part < parts; part++) {
            take(lists, MissionDeviceList.key(mission, part));
        }
        List<WantedDevice> devices = new ArrayList<>();
        view.entries(Topics.DEVICES)
                .map(ServiceView.Entry::value)
                .filter(device -> mission.equals(device.path("mission").textValue())
                        && "running".equals(device.path("wanted").textValue()))
                .forEach(device -> resolve(device, lists).ifPresent(devices::add));
        return devices;
    }

    private Optional<WantedDevice> read(ObjectNode device, MissionDeviceLists lists) {
        take(
                lists,
                MissionDeviceList.key(
                        device.path("mission").asText(),
                        device.at("/group/part").asInt()));
        return resolve(device, lists);
    }

    private void take(MissionDeviceLists lists, String key) {
        view.find(Topics.MISSION_DEVICES, key).ifPresent(list -> lists.take(key, NgsiJson.write(list)));
    }

    /** Without settings where those of its group are not known yet. */
    private static Optional<WantedDevice> resolve(ObjectNode device, MissionDeviceLists lists) {
        try {
            WantedDevice wanted = WantedDevice.read(NgsiJson.write(device));
            return lists.resolve(wanted).or(() -> Optional.of(wanted));
        } catch (UnreadableException e) {
            return Optional.empty(); // the readers of the topic report it
        }
    }
}
