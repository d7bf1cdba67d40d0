package io.furrow.analytics.collision.grid;

import io.furrow.analytics.position.PositionFix;

/** Distances on a sphere of the Earth's mean radius; the same bits on every machine. */
public final class Geodesy {
    public static final double EARTH_RADIUS_METERS = 6_371_000;

    private Geodesy() {}

    /** The great-circle distance in meters by the haversine formula; symmetric, also across the antimeridian. */
    public static double distance(PositionFix a, PositionFix b) {
        double halfLatitudes = Math.toRadians(b.latitude() - a.latitude()) / 2;
        // The remainder is exact: two devices on both sides of the antimeridian keep all digits of their difference.
        double halfLongitudes = Math.toRadians(Math.IEEEremainder(b.longitude() - a.longitude(), 360)) / 2;
        double cosines = StrictMath.cos(Math.toRadians(a.latitude())) * StrictMath.cos(Math.toRadians(b.latitude()));
        double h = square(StrictMath.sin(halfLatitudes)) + cosines * square(StrictMath.sin(halfLongitudes));
        return 2 * EARTH_RADIUS_METERS * StrictMath.asin(Math.min(1, Math.sqrt(h)));
    }

    public static double square(double x) {
        return x * x;
    }
}
