package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.Base64;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalDouble;
import java.util.Set;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.position.Position;
import io.furrow.simulators.camera.CameraView;
import io.furrow.simulators.camera.FieldPicture;
import io.furrow.simulators.robot.FirosEntity;
import io.furrow.simulators.robot.RobotState;
import io.furrow.simulators.robot.Trajectory;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Camera;
import io.furrow.simulators.scenario.SimulatedDevice.Place;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

/**
 * Simulates devices: what each reports when asked, and the effect of commands. Reads no clock: the same devices, asked
 * and commanded the same at the same times in the same order, report the same.
 */
final class FarmSimulation {
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final double NANOS = 1e9;

    private final Map<String, Instant> starts = new HashMap<>();
    private final Map<String, Robot> robots = new HashMap<>();
    private final Map<String, RobotState> states = new HashMap<>();
    private final Map<String, Position> places = new HashMap<>();
    private final Set<String> off = new HashSet<>();
    private final Map<String, Instant> restarting = new HashMap<>();

    /** Adds a device that is switched on and has been on its way since a time. */
    void add(SimulatedDevice device, Instant since, Instant now) {
        starts.put(device.id(), since);
        if (device instanceof Robot robot) {
            robots.put(robot.id(), robot);
            double driven = Math.max(0, Duration.between(since, now).toNanos() / NANOS);
            store(robot, RobotState.starting(now, robot.driven() + driven));
        }
    }

    void remove(String device) {
        robots.remove(device);
        states.remove(device);
        places.remove(device);
        off.remove(device);
        starts.remove(device);
        restarting.remove(device);
    }

    /** The report of a device; empty while it is off, restarting or silent. */
    Optional<Report> report(SimulatedDevice device, Instant now) {
        if (device instanceof Robot robot) {
            RobotState state = advance(robot, now);
            return isDown(robot.id(), now) ? Optional.empty() : Optional.of(update(robot, state));
        }
        if (isDown(device.id(), now)) {
            return Optional.empty();
        }
        return device instanceof Sensor sensor ? measures(sensor, now) : picture((Camera) device, now);
    }

    private boolean isDown(String device, Instant now) {
        Instant until = restarting.get(device);
        return off.contains(device) || until != null && now.isBefore(until);
    }

    /** Silences a device until a time; then it is switched on. */
    void restart(String device, Instant until) {
        off.remove(device);
        restarting.put(device, until);
    }

    /** Switches a device on or off; a last report says that it is off, or its status would stay true. */
    Optional<Report> switchTo(SimulatedDevice device, boolean on, Instant now) {
        boolean changed = on ? off.remove(device.id()) : off.add(device.id());
        return changed && !on && !(device instanceof Robot)
                ? Optional.of(new Report.Measures(
                        device.id(), NODES.objectNode().put("stat", false).put("time", now.toEpochMilli())))
                : Optional.empty();
    }

    /** Stops a robot, or lets it continue, from that time on. */
    void command(Robot robot, boolean stop, Instant now) {
        store(robot, advance(robot, now).commanded(stop));
    }

    private RobotState advance(Robot robot, Instant now) {
        Map<String, Position> others = robot.model().encounterDistance() > 0 ? places : Map.of();
        RobotState state = robot.model().advance(states.get(robot.id()), now, others);
        store(robot, state);
        return state;
    }

    private void store(Robot robot, RobotState state) {
        states.put(robot.id(), state);
        places.put(robot.id(), robot.model().pose(state).place());
    }

    private Trajectory.Pose pose(String device, Place place, Instant now) {
        if (place.carrier() == null) {
            return place.way()
                    .at(Math.max(0, Duration.between(starts.get(device), now).toNanos() / NANOS));
        }
        Robot carrier = robots.get(place.carrier());
        return carrier.model().pose(advance(carrier, now));
    }

    private Optional<Report> measures(Sensor sensor, Instant now) {
        ObjectNode json = NODES.objectNode();
        shown(sensor.quantities(), json, now);
        if (json.isEmpty() || isCarrierRemoved(sensor.place())) {
            return Optional.empty();
        }
        Position place = pose(sensor.id(), sensor.place(), now).place();
        return Optional.of(new Report.Measures(sensor.id(), located(json, place, sensor.place(), now)));
    }

    private Optional<Report> picture(Camera camera, Instant now) {
        if (camera.silent().stream().anyMatch(span -> span.holds(now)) || isCarrierRemoved(camera.place())) {
            return Optional.empty();
        }
        Trajectory.Pose pose = pose(camera.id(), camera.place(), now);
        double heading = camera.heading() == null ? pose.heading() : camera.heading();
        List<Position> robotsAround = places.entrySet().stream()
                .filter(robot -> !robot.getKey().equals(camera.place().carrier()))
                .map(Map.Entry::getValue)
                .toList();
        CameraView view = new CameraView(now, pose.place(), heading, robotsAround);
        ObjectNode json = NODES.objectNode().put("img", Base64.getEncoder().encodeToString(FieldPicture.png(view)));
        shown(camera.battery(), json, now);
        return Optional.of(new Report.Measures(camera.id(), located(json, pose.place(), camera.place(), now)));
    }

    private static void shown(List<SimulatedDevice.Quantity> quantities, ObjectNode json, Instant now) {
        for (SimulatedDevice.Quantity quantity : quantities) {
            OptionalDouble value = quantity.signal().at(now);
            if (value.isPresent()) {
                json.put(quantity.attribute().objectId(), value.getAsDouble());
            }
        }
    }

    /** Whether the robot that carries it was removed. */
    private boolean isCarrierRemoved(Place place) {
        return place.carrier() != null && !robots.containsKey(place.carrier());
    }

    private static ObjectNode located(ObjectNode json, Position position, Place place, Instant now) {
        return json.put("stat", true)
                .put("time", now.toEpochMilli())
                .put("lat", position.latitude())
                .put("lon", position.longitude())
                .put("where", place.where());
    }

    private static Report update(Robot robot, RobotState state) {
        SimulatedDevice.Identity who = robot.identity();
        EntityBuilder entity = FirosEntity.of(who.entity(), robot.model(), state);
        if (robot.workingWidth() > 0) {
            entity.number("workingWidth", robot.workingWidth());
        }
        if (robot.reportsMission()) {
            entity.text("Domain", who.domain()).text("Mission", who.mission());
        }
        return new Report.Update(who.id(), entity.build());
    }
}
