package io.furrow.analytics.collision;

/** Short ways to say where a device is. */
final class Fixes {
    private static final double METERS_PER_DEGREE = Geodesy.EARTH_RADIUS_METERS * Math.PI / 180;

    private Fixes() {}

    static PositionFix at(String device, double latitude, double longitude, long time) {
        return new PositionFix("farm|/|" + device, device, "m", "", latitude, longitude, time);
    }

    /** On the equator, so many metres east of 10° E. */
    static PositionFix east(String device, double meters, long time) {
        return at(device, 0, 10 + meters / METERS_PER_DEGREE, time);
    }

    static PositionFix carriedBy(String carrier, PositionFix fix) {
        return new PositionFix(
                fix.identity(),
                fix.id(),
                fix.mission(),
                "farm|/|" + carrier,
                fix.latitude(),
                fix.longitude(),
                fix.time());
    }
}
