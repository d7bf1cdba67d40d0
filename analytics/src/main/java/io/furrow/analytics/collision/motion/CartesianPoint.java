package io.furrow.analytics.collision.motion;

import io.furrow.analytics.position.PositionFix;

/**
 * A point or a direction in space.
 *
 * @param x meters from the Earth's center towards 0° N 0° E
 * @param y meters towards 0° N 90° E
 * @param z meters towards the north pole
 */
record CartesianPoint(double x, double y, double z) {
    static final double EARTH_RADIUS_METERS = 6_371_000;

    static CartesianPoint of(PositionFix fix) {
        double phi = Math.toRadians(fix.latitude());
        double lambda = Math.toRadians(fix.longitude());
        double cosine = EARTH_RADIUS_METERS * StrictMath.cos(phi);
        return new CartesianPoint(
                cosine * StrictMath.cos(lambda),
                cosine * StrictMath.sin(lambda),
                EARTH_RADIUS_METERS * StrictMath.sin(phi));
    }

    /** The unit vector at the position's place in a direction, in degrees clockwise from north. */
    static CartesianPoint heading(PositionFix fix, double degrees) {
        double phi = Math.toRadians(fix.latitude());
        double lambda = Math.toRadians(fix.longitude());
        double north = StrictMath.cos(Math.toRadians(degrees));
        double east = StrictMath.sin(Math.toRadians(degrees));
        double outward = -StrictMath.sin(phi) * north;
        return new CartesianPoint(
                outward * StrictMath.cos(lambda) - east * StrictMath.sin(lambda),
                outward * StrictMath.sin(lambda) + east * StrictMath.cos(lambda),
                StrictMath.cos(phi) * north);
    }

    CartesianPoint plus(CartesianPoint other) {
        return new CartesianPoint(x + other.x, y + other.y, z + other.z);
    }

    CartesianPoint minus(CartesianPoint other) {
        return new CartesianPoint(x - other.x, y - other.y, z - other.z);
    }

    CartesianPoint times(double factor) {
        return new CartesianPoint(factor * x, factor * y, factor * z);
    }

    double dot(CartesianPoint other) {
        return x * other.x + y * other.y + z * other.z;
    }

    double length() {
        return Math.sqrt(dot(this));
    }

    /** Meters along the ground between two points on it. */
    double distance(CartesianPoint other) {
        double chord = minus(other).length();
        return 2 * EARTH_RADIUS_METERS * StrictMath.asin(Math.min(1, chord / (2 * EARTH_RADIUS_METERS)));
    }

    /** Without the component perpendicular to the ground at that point. */
    CartesianPoint alongTheGroundAt(CartesianPoint ground) {
        return minus(ground.times(dot(ground) / ground.dot(ground)));
    }

    /** Degrees. */
    double latitude() {
        return Math.toDegrees(StrictMath.asin(Math.max(-1, Math.min(1, z / length()))));
    }

    /** Degrees, −180 to 180. */
    double longitude() {
        return Math.toDegrees(StrictMath.atan2(y, x));
    }
}
