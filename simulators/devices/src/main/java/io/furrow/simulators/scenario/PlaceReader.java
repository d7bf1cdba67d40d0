package io.furrow.simulators.scenario;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;

import io.furrow.model.position.Position;
import io.furrow.simulators.robot.Trajectory;
import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.signal.RandomStream;

/**
 * Reads the place of a device: {@code at} a place, along a {@code route}, within an {@code area}, or in {@code rows} of
 * a field.
 */
final class PlaceReader {
    private static final double MAX_SPEED = 50;
    private static final int TRIES = 1_000;
    private static final int MAX_NAMED = 20;

    private final Map<String, WorkField> fields;

    /** Shared by the robots of a group, costly for large fields. */
    private final Map<Plan, Trajectory> ways = new HashMap<>();

    private record Plan(String field, Trajectory.Work work, Trajectory.Pace pace) {}

    PlaceReader(Map<String, WorkField> fields) {
        this.fields = fields;
    }

    /** The place of a device that is not carried. */
    SimulatedDevice.Place place(ScenarioObjectReader device, long seed) throws InvalidScenarioException {
        once(device, "area", "at", "route", "carriedBy");
        String where = device.reported("where", device.reported("area", ""));
        if (device.has("area")) {
            Position drawn = somewhereIn(field(device, "area"), seed);
            return new SimulatedDevice.Place(where, standing(drawn), null);
        }
        if (device.has("at")) {
            return new SimulatedDevice.Place(where, standing(position(device.object("at"))), null);
        }
        if (device.has("route")) {
            return new SimulatedDevice.Place(where, route(device), null);
        }
        throw device.refused("area", "is missing; say where it is with one of area, at, route or carriedBy");
    }

    /** The way of a robot. */
    Trajectory way(ScenarioObjectReader device) throws InvalidScenarioException {
        once(device, "rows", "route");
        if (!device.has("rows")) {
            if (!device.has("route")) {
                throw device.refused("rows", "is missing; a robot needs either rows or a route");
            }
            return route(device);
        }
        ScenarioObjectReader rows = device.object("rows");
        WorkField field = field(rows, "field");
        Double bearing = rows.has("bearing") ? Double.valueOf(rows.number("bearing", 0, 360)) : null;
        Trajectory.Work work =
                new Trajectory.Work(rows.number("spacing", 0.2, 1000, 3), rows.number("margin", 0.2, 1000, 2), bearing);
        rows.end();
        Trajectory.Pace pace = pace(device);
        try {
            return ways.computeIfAbsent(
                    new Plan(field.id(), work, pace), plan -> Trajectory.through(field, work, pace));
        } catch (IllegalArgumentException e) {
            throw device.refused("rows", e);
        }
    }

    /** Refuses more than one of several members that describe the place. */
    static void once(ScenarioObjectReader device, String... names) throws InvalidScenarioException {
        String source = null;
        for (String name : names) {
            if (device.has(name) && source != null) {
                throw device.refused(name, "says again where the device is, after %s; leave one out".formatted(source));
            }
            source = device.has(name) ? name : source;
        }
    }

    private Trajectory route(ScenarioObjectReader device) throws InvalidScenarioException {
        List<Position> points = new ArrayList<>();
        for (ScenarioObjectReader point : device.objects("route")) {
            points.add(position(point));
        }
        if (points.isEmpty()) {
            throw device.refused("route", "has no point; give at least one {latitude, longitude}");
        }
        return Trajectory.along(points, pace(device));
    }

    private static Trajectory.Pace pace(ScenarioObjectReader device) throws InvalidScenarioException {
        return new Trajectory.Pace(device.number("speed", 0.01, MAX_SPEED, 1), device.number("turnRate", 1, 3600, 90));
    }

    private static Trajectory standing(Position place) {
        return Trajectory.along(List.of(place), new Trajectory.Pace(1, 90));
    }

    private static Position position(ScenarioObjectReader point) throws InvalidScenarioException {
        Position position = new Position(point.number("latitude", -90, 90), point.number("longitude", -180, 180));
        point.end();
        return position;
    }

    private WorkField field(ScenarioObjectReader device, String name) throws InvalidScenarioException {
        WorkField field = fields.get(device.text(name));
        if (field == null) {
            throw device.refused(
                    name,
                    "there is no field '%s'; there are: %s"
                            .formatted(
                                    device.text(name),
                                    fields.keySet().stream().limit(MAX_NAMED).collect(Collectors.joining(", "))));
        }
        return field;
    }

    /** A place drawn evenly from the field's area. */
    private static Position somewhereIn(WorkField field, long seed) {
        Envelope extent = field.area().getEnvelopeInternal();
        for (int number = 0; number < TRIES; number++) {
            var draw = RandomStream.of(seed, number);
            Coordinate place = new Coordinate(
                    extent.getMinX() + draw.nextDouble() * extent.getWidth(),
                    extent.getMinY() + draw.nextDouble() * extent.getHeight());
            if (field.covers(place)) {
                return field.plane().toPosition(place);
            }
        }
        return field.plane().toPosition(field.area().getInteriorPoint().getCoordinate());
    }
}
