package io.furrow.analytics.collision;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.position.PositionFix;

/** Short ways to say where a device is. */
public final class Fixes {
    private static final double METERS_PER_DEGREE = Geodesy.EARTH_RADIUS_METERS * Math.PI / 180;

    private Fixes() {}

    public static PositionFix at(String device, double latitude, double longitude, long time) {
        return of("farm|/|" + device, device, "m", latitude, longitude, time);
    }

    /** A robot of the usual topic that no one carries, of unknown speed and heading. */
    public static PositionFix of(
            String identity, String id, String mission, double latitude, double longitude, long time) {
        return new PositionFix(
                "data.raw", identity, id, "ROBOT", mission, "", latitude, longitude, Double.NaN, Double.NaN, time);
    }

    /** On the equator, so many meters east of 10° E. */
    public static PositionFix east(String device, double meters, long time) {
        return at(device, 0, 10 + meters / METERS_PER_DEGREE, time);
    }

    public static PositionFix carriedBy(String carrier, PositionFix fix) {
        return carriedByIdentity("farm|/|" + carrier, fix);
    }

    public static PositionFix carriedByIdentity(String carrier, PositionFix fix) {
        return new PositionFix(
                fix.topic(),
                fix.identity(),
                fix.id(),
                fix.type(),
                fix.mission(),
                carrier,
                fix.latitude(),
                fix.longitude(),
                fix.speed(),
                fix.heading(),
                fix.time());
    }

    public static PositionFix ofType(String type, PositionFix fix) {
        return new PositionFix(
                fix.topic(),
                fix.identity(),
                fix.id(),
                type,
                fix.mission(),
                fix.carrier(),
                fix.latitude(),
                fix.longitude(),
                fix.speed(),
                fix.heading(),
                fix.time());
    }

    /** The same in another tenant, so that worlds at one time do not share devices. */
    public static PositionFix ofFarm(String farm, PositionFix fix) {
        String carrier = fix.carrier().isEmpty() ? "" : farm + fix.carrier();
        PositionFix there =
                of(farm + fix.identity(), fix.id(), fix.mission(), fix.latitude(), fix.longitude(), fix.time());
        return ofType(fix.type(), carriedByIdentity(carrier, there));
    }

    static PositionFix turned(PositionFix fix, double longitude) {
        return ofType(
                fix.type(),
                carriedByIdentity(
                        fix.carrier(),
                        of(fix.identity(), fix.id(), fix.mission(), fix.latitude(), longitude, fix.time())));
    }
}
