package io.furrow.simulators.fleet;

import java.util.ArrayList;
import java.util.List;

import io.furrow.simulators.device.Registration;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

/** Describes the devices of a farm to the IoT Agent; robots are not registered there. */
final class Registrations {
    static final List<String> COMMANDS = List.of("on", "off", "restart");

    private Registrations() {}

    static List<Registration> of(Farm farm) {
        return farm.devices().stream()
                .filter(device -> !(device instanceof Robot))
                .map(Registrations::of)
                .toList();
    }

    private static Registration of(SimulatedDevice device) {
        List<Registration.Attribute> attributes = new ArrayList<>();
        if (device instanceof Sensor sensor) {
            sensor.quantities().forEach(quantity -> attributes.add(quantity.attribute()));
        } else {
            // The context broker refuses the = of base64 in ordinary text.
            attributes.add(new Registration.Attribute("img", "Image", "TextUnrestricted"));
            ((SimulatedDevice.Camera) device).battery().forEach(quantity -> attributes.add(quantity.attribute()));
        }
        attributes.add(new Registration.Attribute("stat", "Status", "Boolean"));
        attributes.add(new Registration.Attribute("time", "Time", "Integer"));
        attributes.add(new Registration.Attribute("lat", "Latitude", "Float"));
        attributes.add(new Registration.Attribute("lon", "Longitude", "Float"));
        attributes.add(new Registration.Attribute("where", "Location", "String"));
        Identity who = device.identity();
        return new Registration(
                who.id(),
                new Registration.Entity(who.entity(), who.type()),
                attributes,
                new Registration.MissionOf(who.domain(), who.mission()),
                COMMANDS);
    }
}
