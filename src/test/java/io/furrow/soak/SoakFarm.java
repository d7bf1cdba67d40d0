package io.furrow.soak;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.position.Position;

/**
 * Two static thermometers and two robots that drive towards and away from each other, in the fields of {@code
 * src/test/soak/fields.geojson}: {@code farm} contains all of them, {@code corner} the second thermometer only.
 */
final class SoakFarm {
    static final String DOMAIN = "soak";
    static final String MISSION = "numbers";
    static final String FIRST_THERMOMETER = "urn:ngsi-ld:Thermometer:soak-1";
    static final String SECOND_THERMOMETER = "urn:ngsi-ld:Thermometer:soak-2";
    static final String FIRST_ROBOT = "urn:ngsi-ld:Robot:soak-1";
    static final String SECOND_ROBOT = "urn:ngsi-ld:Robot:soak-2";
    static final int DEVICES = 4;

    private static final double LATITUDE = 40.3134;
    private static final double LONGITUDE = -3.4830;
    private static final double DEGREES_PER_METER = 1 / 111_195.0;
    /** The robots drive 12 m apart and back within the period, so that they are within 5 m of each other once. */
    private static final double METERS_APART = 12;

    private static final long PERIOD_MILLIS = 7_000;
    /** Adjacent events have different values, so that a lost or repeated reading changes a median. */
    private static final long READINGS = 97;

    private SoakFarm() {}

    /** The report number {@code number}, of the device whose turn it is, at {@code time}, epoch ms. */
    static Entity report(long number, long time) {
        return switch ((int) (number % DEVICES)) {
            case 0 -> thermometer(FIRST_THERMOMETER, number, time, 0);
            case 1 -> thermometer(SECOND_THERMOMETER, number, time, 80);
            case 2 -> robot(FIRST_ROBOT, number, time, 0);
            default -> robot(SECOND_ROBOT, number, time, metersApart(time));
        };
    }

    private static Entity thermometer(String id, long number, long time, double metersNorth) {
        return device(
                        id,
                        "Thermometer",
                        number,
                        time,
                        new Position(LATITUDE + metersNorth * DEGREES_PER_METER, LONGITUDE))
                .number("Temperature", 15 + (number % READINGS) / 10.0)
                .build();
    }

    private static Entity robot(String id, long number, long time, double metersNorth) {
        double latitude = LATITUDE + (30 + metersNorth) * DEGREES_PER_METER;
        return device(id, "Robot", number, time, new Position(latitude, LONGITUDE))
                .build();
    }

    private static double metersApart(long time) {
        return METERS_APART * Math.abs(Math.sin(Math.PI * (time % PERIOD_MILLIS) / PERIOD_MILLIS));
    }

    private static EntityBuilder device(String id, String type, long number, long time, Position position) {
        return Entity.builder(id, type)
                .text("Domain", DOMAIN)
                .text("Mission", MISSION)
                .integer("Number", number)
                .integer("Time", time)
                .number("Latitude", position.latitude())
                .number("Longitude", position.longitude());
    }
}
