package io.furrow.analytics.collision.motion;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.record.Epochs;

/**
 * A straight, uniform motion of one device.
 *
 * @param fix the newer position of a segment behind, or the start of a segment ahead
 * @param from time at its start, epoch milliseconds
 * @param until time at its end
 * @param x start, meters from the Earth's center towards 0° N 0° E
 * @param y meters towards 0° N 90° E
 * @param z meters towards the north pole
 * @param vx meters per millisecond
 * @param vy meters per millisecond
 * @param vz meters per millisecond
 */
public record MotionSegment(
        PositionFix fix, long from, long until, double x, double y, double z, double vx, double vy, double vz) {
    static MotionSegment of(PositionFix fix, long from, long until, CartesianPoint start, CartesianPoint velocity) {
        return new MotionSegment(
                fix, from, until, start.x(), start.y(), start.z(), velocity.x(), velocity.y(), velocity.z());
    }

    /**
     * The location on the segment at a time; at its end, the newest position itself.
     *
     * @param time the original one, epoch milliseconds: a double cannot represent the milliseconds of a late epoch's event time
     */
    CartesianPoint at(double time) {
        double elapsed = time - Epochs.original(from);
        return new CartesianPoint(x + vx * elapsed, y + vy * elapsed, z + vz * elapsed);
    }

    CartesianPoint start() {
        return new CartesianPoint(x, y, z);
    }

    CartesianPoint velocity() {
        return new CartesianPoint(vx, vy, vz);
    }

    /** The same device at another original time and place on the segment. */
    PositionFix fixAt(double time) {
        CartesianPoint there = at(time);
        return new PositionFix(
                fix.reporter(),
                there.latitude(),
                there.longitude(),
                1000 * velocity().length(),
                fix.heading(),
                Epochs.begin(from) + (long) time);
    }
}
