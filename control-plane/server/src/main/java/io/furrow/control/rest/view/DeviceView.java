package io.furrow.control.rest.view;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.health.SilenceCause;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.device.MissionDeviceLists;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads desired devices with the settings of their groups and with their connections. */
public record DeviceView(StateView view) {
    /** @param identity tenant, service path and id of the entity */
    public Optional<DesiredDevice> find(String identity) {
        return view.find(Topics.DEVICES, identity).flatMap(device -> read(device, new MissionDeviceLists()));
    }

    /** Returns the devices of a mission that are desired to run. */
    public List<DesiredDevice> of(String mission) {
        MissionDeviceLists lists = new MissionDeviceLists();
        int parts = view.find(Topics.MISSIONS, mission)
                .map(found -> found.path("parts").asInt())
                .orElse(0);
        for (int part = 0; part < parts; part++) {
            take(lists, MissionDeviceList.key(mission, part));
        }
        List<DesiredDevice> devices = new ArrayList<>();
        view.entries(Topics.DEVICES)
                .map(StateView.Entry::value)
                .filter(device -> mission.equals(device.path("mission").textValue())
                        && "running".equals(device.path("wanted").textValue()))
                .forEach(device -> resolve(device, lists).ifPresent(devices::add));
        return devices;
    }

    /**
     * Returns a device's type in the spelling of its last report, else of the request: a robot of FIROS, which is
     * desired as {@code Robot}, reports {@code ROBOT}.
     */
    public String spelledType(String key, String requested, String desired) {
        String reported = view.find(Topics.DEVICES_HEALTH, key)
                .filter(health -> health.hasNonNull("heard"))
                .map(health -> health.path("type").asText())
                .orElse(requested);
        return Stream.of(reported, requested)
                .filter(desired::equalsIgnoreCase)
                .findFirst()
                .orElse(desired);
    }

    /** Adds status and health of a device. */
    public ObjectNode withStatus(String key, ObjectNode desired) {
        view.find(Topics.DEVICES_STATUS, key).ifPresent(status -> desired.set("status", status));
        view.find(Topics.DEVICES_HEALTH, key).ifPresent(health -> {
            desired.set("health", health);
            boolean isUp = !desired.path("simulated").asBoolean()
                    && "running".equals(desired.path("wanted").textValue())
                    && health.path("heard").asLong() >= desired.path("from").asLong();
            if (isUp) { // a real device has no host that confirms it
                desired.putObject("status").put("state", "running").set("sequence", desired.path("sequence"));
            }
        });
        return desired;
    }

    /** Adds the connection of a device; lists of devices omit it. */
    public ObjectNode withConnection(String key, ObjectNode device) {
        ObjectNode connection = view.find(Topics.DEVICES_CONNECTION, key).orElseGet(NgsiJson::object);
        JsonNode health = device.path("health");
        Long heard = health.hasNonNull("heard") ? health.path("heard").longValue() : null;
        silence(connection, device).ifPresent(cause -> connection.put("cause", cause.text()));
        if (heard != null) {
            long time = health.path(health.has("deviceTime") ? "deviceTime" : "lastSeen")
                    .longValue();
            connection
                    .putObject("lastReport")
                    .put("time", time)
                    .put("received", heard)
                    .put("offset", heard - time);
        }
        return connection.isEmpty() ? device : device.set("connection", connection);
    }

    private static Optional<SilenceCause> silence(ObjectNode connection, ObjectNode device) {
        if (connection.isEmpty()) {
            return Optional.empty();
        }
        long from = device.path("from").longValue();
        long heard = device.path("health").path("heard").longValue();
        JsonNode status = device.path("status");
        boolean current =
                status.path("sequence").longValue() >= device.path("sequence").longValue();
        try {
            DeviceConnection existing = DeviceConnection.read(NgsiJson.write(connection));
            if (heard >= from && heard > 0) {
                boolean silent = device.path("health").path("silent").booleanValue();
                return silent ? SilenceCause.of(existing, heard) : Optional.empty();
            }
            String failure = current ? status.path("reason").textValue() : null;
            return Optional.of(SilenceCause.ofUnheard(existing, failure, from));
        } catch (UnreadableException e) { // written by a later version or another program; shown without a cause
            return Optional.empty();
        }
    }

    private Optional<DesiredDevice> read(ObjectNode device, MissionDeviceLists lists) {
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

    /** Returns the device without settings if its device list was not read yet. */
    private static Optional<DesiredDevice> resolve(ObjectNode device, MissionDeviceLists lists) {
        try {
            DesiredDevice desired = DesiredDevice.read(NgsiJson.write(device));
            return lists.resolve(desired).or(() -> Optional.of(desired));
        } catch (UnreadableException e) {
            return Optional.empty(); // the readers of the topic report it
        }
    }
}
