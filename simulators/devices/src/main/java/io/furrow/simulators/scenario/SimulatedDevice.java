package io.furrow.simulators.scenario;

import java.time.Duration;
import java.util.Collection;
import java.util.List;

import io.furrow.simulators.device.DeviceRegistration;
import io.furrow.simulators.robot.RobotModel;
import io.furrow.simulators.robot.Trajectory;
import io.furrow.simulators.signal.Signal;
import io.furrow.simulators.signal.TimeWindow;

/** A device of a farm, from which all its reports follow at given times. */
public sealed interface SimulatedDevice {
    Identity identity();

    Duration period();

    default String id() {
        return identity().id();
    }

    /** The devices that report over MQTT: all but robots. */
    static List<Identity> overMqtt(Collection<SimulatedDevice> devices) {
        return devices.stream()
                .filter(device -> !(device instanceof Robot))
                .map(SimulatedDevice::identity)
                .toList();
    }

    /**
     * @param id at the IoT Agent and in MQTT topics; of a robot its name
     *
     * @param entity entity id in the context broker
     * @param type NGSI type of the entity
     * @param generation number of rotations of its credentials
     */
    record Identity(String id, String entity, String type, String domain, String mission, int generation) {
        /** A device whose credentials were never rotated. */
        public Identity(String id, String entity, String type, String domain, String mission) {
            this(id, entity, type, domain, mission, 0);
        }
    }

    /**
     * The place of a device.
     *
     * @param where name of the place
     * @param way its route or place; null if it is carried
     * @param carrier id of the robot that carries it; null if none does
     */
    record Place(String where, Trajectory way, String carrier) {}

    /** A quantity measured by a sensor. */
    record Quantity(DeviceRegistration.Attribute attribute, Signal signal) {}

    /** A thermometer or weather station; silent when none of its quantities has a reading. */
    record Sensor(Identity identity, Duration period, Place place, List<Quantity> quantities)
            implements SimulatedDevice {}

    /**
     * A camera.
     *
     * @param heading degrees clockwise from north; null for that of its carrier or way
     * @param silent when it takes no pictures
     * @param battery its charge as an additional attribute; empty if it reports none
     */
    record Camera(
            Identity identity,
            Duration period,
            Place place,
            Double heading,
            List<TimeWindow> silent,
            List<Quantity> battery)
            implements SimulatedDevice {}

    /**
     * A robot.
     *
     * @param driven seconds of its way behind it at the start
     * @param workingWidth of its implement, meters; 0 if it reports none
     * @param reportsMission whether it reports {@code Domain} and {@code Mission}, which FIROS does not
     */
    record Robot(
            Identity identity,
            Duration period,
            RobotModel model,
            double driven,
            double workingWidth,
            boolean reportsMission)
            implements SimulatedDevice {}
}
