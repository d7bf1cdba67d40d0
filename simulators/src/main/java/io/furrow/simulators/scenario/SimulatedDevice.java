package io.furrow.simulators.scenario;

import java.time.Duration;
import java.util.Collection;
import java.util.List;

import io.furrow.simulators.device.Registration;
import io.furrow.simulators.robot.RobotModel;
import io.furrow.simulators.robot.Way;
import io.furrow.simulators.signal.Signal;
import io.furrow.simulators.signal.Span;

/** One device of a farm: all that it will ever show follows from this and from the times at which it is asked. */
public sealed interface SimulatedDevice {
    Identity identity();

    /** How often it reports. */
    Duration period();

    default String id() {
        return identity().id();
    }

    /** Who of these reports over MQTT: all but robots. */
    static List<Identity> overMqtt(Collection<SimulatedDevice> devices) {
        return devices.stream()
                .filter(device -> !(device instanceof Robot))
                .map(SimulatedDevice::identity)
                .toList();
    }

    /**
     * @param id at the IoT Agent and in MQTT topics; of a robot, which has none there, its name
     * @param entity id of its entity in the context broker
     * @param type NGSI type of the entity
     * @param generation how often its credentials were rotated
     */
    record Identity(String id, String entity, String type, String domain, String mission, int generation) {
        /** A device whose credentials were never rotated. */
        public Identity(String id, String entity, String type, String domain, String mission) {
            this(id, entity, type, domain, mission, 0);
        }
    }

    /**
     * Where a device is.
     *
     * @param where name of the place
     * @param way what it goes along, or where it stands; null where it is carried
     * @param carrier id of the robot that carries it; null where none does
     */
    record Place(String where, Way way, String carrier) {}

    /** One of the quantities that a sensor measures. */
    record Quantity(Registration.Attribute attribute, Signal signal) {}

    /** A thermometer or weather station; it is silent when none of its quantities says anything. */
    record Sensor(Identity identity, Duration period, Place place, List<Quantity> quantities)
            implements SimulatedDevice {}

    /**
     * A camera.
     *
     * @param heading where it looks, degrees clockwise from north; null for where its carrier, or its way, goes
     * @param silent when it takes no pictures
     * @param battery what else it tells, the charge of its battery; empty where it tells none
     */
    record Camera(
            Identity identity, Duration period, Place place, Double heading, List<Span> silent, List<Quantity> battery)
            implements SimulatedDevice {}

    /**
     * A robot.
     *
     * @param driven seconds of its way that lie behind it when it starts
     * @param tellsMission whether it reports {@code Domain} and {@code Mission}, which FIROS by itself does not
     */
    record Robot(Identity identity, Duration period, RobotModel model, double driven, boolean tellsMission)
            implements SimulatedDevice {}
}
