package io.furrow.analytics.collision.motion;

import java.io.Serializable;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;

import io.furrow.analytics.position.PositionFix;

/** Creates segments from the positions of one device and adds them to cubes. */
final class SegmentBuilder implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final long[] NO_CUBES = {};

    private final MotionRules rules;
    private final Cubes cubes;

    SegmentBuilder(MotionRules rules) {
        this.rules = rules;
        cubes = new Cubes(rules);
    }

    /** The resulting state, null for none; {@code tooFast} counts positions that no machine could have reached. */
    record Advanced(MotionState known, int tooFast) {}

    /**
     * Follows a device through its positions.
     *
     * @param before null without earlier state
     * @param due in the order of {@link PositionFix#SEQUENCE}
     */
    Advanced advance(MotionState before, List<PositionFix> due, Consumer<SegmentUpdate> out) {
        MotionState known = before;
        int tooFast = 0;
        for (int i = 0; i < due.size(); i++) {
            PositionFix fix = due.get(i);
            boolean outdone = i + 1 < due.size() && due.get(i + 1).time() == fix.time();
            if (outdone) {
                continue;
            }
            if (rules.common().positions().zones().cover(fix.latitude(), fix.longitude())) {
                emitAhead(known, null, fix.time(), out);
                known = null;
                continue;
            }
            MotionSegment behind = known != null && fix.time() < expiry(known) ? behind(known.last(), fix) : null;
            MotionSegment ahead = rules.predicts() ? ahead(behind, fix) : null;
            tooFast += isTooFast(behind) || isTooFast(ahead) ? 1 : 0;
            MotionState now = new MotionState(fix, usable(ahead));
            emitAhead(known, now.ahead(), fix.time(), out);
            emitBehind(usable(behind), out);
            known = now;
        }
        return new Advanced(known, tooFast);
    }

    /** The first instant at which the state is no longer valid. */
    long expiry(MotionState known) {
        return known.last().time() + rules.timeToLive();
    }

    private void emitAhead(MotionState before, MotionSegment ahead, long time, Consumer<SegmentUpdate> out) {
        MotionSegment former = before == null ? null : before.ahead();
        long[] left = former == null ? NO_CUBES : cubes.touched(former);
        long[] entered = ahead == null ? NO_CUBES : cubes.touched(ahead);
        for (long cube : left) {
            if (Arrays.binarySearch(entered, cube) < 0) {
                out.accept(new SegmentUpdate(cube, time, SegmentUpdate.Change.PREDICTION_ENDED, former));
            }
        }
        for (long cube : entered) {
            out.accept(new SegmentUpdate(cube, time, SegmentUpdate.Change.PREDICTED, ahead));
        }
    }

    private void emitBehind(MotionSegment behind, Consumer<SegmentUpdate> out) {
        if (behind != null && rules.crossed()) {
            for (long cube : cubes.touched(behind)) {
                out.accept(new SegmentUpdate(cube, behind.until(), SegmentUpdate.Change.OBSERVED, behind));
            }
        }
    }

    private static MotionSegment behind(PositionFix before, PositionFix fix) {
        CartesianPoint start = CartesianPoint.of(before);
        CartesianPoint velocity = CartesianPoint.of(fix).minus(start).times(1.0 / (fix.time() - before.time()));
        return MotionSegment.of(fix, before.time(), fix.time(), start, velocity);
    }

    private MotionSegment ahead(MotionSegment behind, PositionFix fix) {
        CartesianPoint start = CartesianPoint.of(fix);
        long until = fix.time() + rules.horizon().toMillis();
        return velocity(behind, fix, start)
                .map(velocity -> MotionSegment.of(fix, fix.time(), until, start, velocity))
                .orElse(null);
    }

    /** Meters per millisecond: as reported, else derived from the previous position. */
    private static Optional<CartesianPoint> velocity(MotionSegment behind, PositionFix fix, CartesianPoint start) {
        boolean hasCourse = fix.speed() == 0 || !Double.isNaN(fix.speed()) && !Double.isNaN(fix.heading());
        if (hasCourse) {
            double heading = Double.isNaN(fix.heading()) ? 0 : fix.heading();
            return Optional.of(CartesianPoint.heading(fix, heading).times(fix.speed() / 1000));
        }
        return Optional.ofNullable(behind).map(segment -> segment.velocity().alongTheGroundAt(start));
    }

    private MotionSegment usable(MotionSegment segment) {
        return isTooFast(segment) ? null : segment;
    }

    private boolean isTooFast(MotionSegment segment) {
        return segment != null && 1000 * segment.velocity().length() > rules.maxSpeed();
    }
}
