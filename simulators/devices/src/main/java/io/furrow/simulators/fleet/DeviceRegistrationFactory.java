package io.furrow.simulators.fleet;

import java.util.ArrayList;
import java.util.List;

import io.furrow.simulators.device.DeviceRegistration;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

/** Describes the devices of a farm to the IoT Agent; robots are not registered there. */
final class DeviceRegistrationFactory {
    static final List<String> COMMANDS = List.of("on", "off", "restart");

    private DeviceRegistrationFactory() {}

    static List<DeviceRegistration> of(Farm farm) {
        return farm.devices().stream()
                .filter(device -> !(device instanceof Robot))
                .map(DeviceRegistrationFactory::of)
                .toList();
    }

    private static DeviceRegistration of(SimulatedDevice device) {
        List<DeviceRegistration.Attribute> attributes = new ArrayList<>();
        if (device instanceof Sensor sensor) {
            sensor.quantities().forEach(quantity -> attributes.add(quantity.attribute()));
        } else {
            // The context broker refuses the = of base64 in ordinary text.
            attributes.add(new DeviceRegistration.Attribute("img", "Image", "TextUnrestricted"));
            ((SimulatedDevice.Camera) device).battery().forEach(quantity -> attributes.add(quantity.attribute()));
        }
        attributes.add(new DeviceRegistration.Attribute("stat", "Status", "Boolean"));
        attributes.add(new DeviceRegistration.Attribute("time", "Time", "Integer"));
        attributes.add(new DeviceRegistration.Attribute("lat", "Latitude", "Float"));
        attributes.add(new DeviceRegistration.Attribute("lon", "Longitude", "Float"));
        attributes.add(new DeviceRegistration.Attribute("where", "Location", "String"));
        Identity who = device.identity();
        return new DeviceRegistration(
                who.id(),
                new DeviceRegistration.Entity(who.entity(), who.type()),
                attributes,
                new DeviceRegistration.MissionOf(who.domain(), who.mission()),
                COMMANDS);
    }
}
