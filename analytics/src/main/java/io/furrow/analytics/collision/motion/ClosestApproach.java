package io.furrow.analytics.collision.motion;

import java.util.Optional;

/**
 * The closest approach of two straight motions within an interval.
 *
 * @param time of the closest point, epoch milliseconds with a fraction, original time like all here
 * @param distance meters between them then
 * @param contactFrom start of the contact within the threshold, epoch milliseconds with a fraction
 * @param contactUntil its end
 */
record ClosestApproach(double time, double distance, double contactFrom, double contactUntil) {
    /** Below this relative speed (a meter in 30 years) the distance is constant. */
    private static final double STANDSTILL = 1e-24;

    /** Empty if they do not come within the threshold, in meters, between {@code from} and {@code until}. */
    static Optional<ClosestApproach> within(double threshold, MotionSegment a, MotionSegment b, long from, long until) {
        if (from > until) {
            return Optional.empty();
        }
        CartesianPoint apart = a.at(from).minus(b.at(from));
        CartesianPoint velocity = a.velocity().minus(b.velocity());
        // The squared distance is a parabola over time: speed·t² + 2·approach·t + gap + threshold².
        double speed = velocity.dot(velocity);
        double approach = apart.dot(velocity);
        double gap = apart.dot(apart) - threshold * threshold;
        double length = until - from;
        if (speed < STANDSTILL) {
            return gap <= 0 ? Optional.of(new ClosestApproach(from, apart.length(), from, until)) : Optional.empty();
        }
        double closest = Math.max(0, Math.min(length, -approach / speed));
        double distance = apart.plus(velocity.times(closest)).length();
        if (!(distance <= threshold)) {
            return Optional.empty();
        }
        double half = Math.sqrt(Math.max(0, approach * approach - speed * gap)) / speed;
        double middle = -approach / speed;
        double first = Math.max(0, Math.min(closest, middle - half));
        double last = Math.min(length, Math.max(closest, middle + half));
        return Optional.of(new ClosestApproach(from + closest, distance, from + first, from + last));
    }
}
