package io.furrow.analytics.collision.motion;

import java.io.Serializable;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;

import io.furrow.analytics.position.PositionFix;

/** Creates legs from the positions of one device and adds them to cubes. */
final class SegmentBuilder implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final long[] NO_CUBES = {};

    private final MotionRules rules;
    private final Cubes cubes;

    SegmentBuilder(MotionRules rules) {
        this.rules = rules;
        cubes = new Cubes(rules);
    }

    /** What is known of the device in the end, null for nothing; {@code tooFast} counts what no machine could have made. */
    record Advanced(KnownMotion known, int tooFast) {}

    /**
     * Follows a device through its positions.
     *
     * @param before null if nothing is known
     * @param due in the order of {@link PositionFix#SEQUENCE}
     */
    Advanced advance(KnownMotion before, List<PositionFix> due, Consumer<LegUpdate> out) {
        KnownMotion known = before;
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
            Leg behind = known != null && fix.time() < expiry(known) ? behind(known.last(), fix) : null;
            Leg ahead = rules.predicts() ? ahead(behind, fix) : null;
            tooFast += isTooFast(behind) || isTooFast(ahead) ? 1 : 0;
            KnownMotion now = new KnownMotion(fix, usable(ahead));
            emitAhead(known, now.ahead(), fix.time(), out);
            emitBehind(usable(behind), out);
            known = now;
        }
        return new Advanced(known, tooFast);
    }

    /** The first instant at which nothing that is known counts any more. */
    long expiry(KnownMotion known) {
        return known.last().time() + rules.timeToLive();
    }

    private void emitAhead(KnownMotion before, Leg ahead, long time, Consumer<LegUpdate> out) {
        Leg former = before == null ? null : before.ahead();
        long[] left = former == null ? NO_CUBES : cubes.touched(former);
        long[] entered = ahead == null ? NO_CUBES : cubes.touched(ahead);
        for (long cube : left) {
            if (Arrays.binarySearch(entered, cube) < 0) {
                out.accept(new LegUpdate(cube, time, LegUpdate.Change.NO_LEG_AHEAD, former));
            }
        }
        for (long cube : entered) {
            out.accept(new LegUpdate(cube, time, LegUpdate.Change.LEG_AHEAD, ahead));
        }
    }

    private void emitBehind(Leg behind, Consumer<LegUpdate> out) {
        if (behind != null && rules.crossed()) {
            for (long cube : cubes.touched(behind)) {
                out.accept(new LegUpdate(cube, behind.until(), LegUpdate.Change.LEG_BEHIND, behind));
            }
        }
    }

    private static Leg behind(PositionFix before, PositionFix fix) {
        CartesianPoint start = CartesianPoint.of(before);
        CartesianPoint velocity = CartesianPoint.of(fix).minus(start).times(1.0 / (fix.time() - before.time()));
        return Leg.of(fix, before.time(), fix.time(), start, velocity);
    }

    private Leg ahead(Leg behind, PositionFix fix) {
        CartesianPoint start = CartesianPoint.of(fix);
        long until = fix.time() + rules.horizon().toMillis();
        return velocity(behind, fix, start)
                .map(velocity -> Leg.of(fix, fix.time(), until, start, velocity))
                .orElse(null);
    }

    /** Meters per millisecond: as reported, else as from the position before. */
    private static Optional<CartesianPoint> velocity(Leg behind, PositionFix fix, CartesianPoint start) {
        boolean told = fix.speed() == 0 || !Double.isNaN(fix.speed()) && !Double.isNaN(fix.heading());
        if (told) {
            double heading = Double.isNaN(fix.heading()) ? 0 : fix.heading();
            return Optional.of(CartesianPoint.heading(fix, heading).times(fix.speed() / 1000));
        }
        return Optional.ofNullable(behind).map(leg -> leg.velocity().alongTheGroundAt(start));
    }

    private Leg usable(Leg leg) {
        return isTooFast(leg) ? null : leg;
    }

    private boolean isTooFast(Leg leg) {
        return leg != null && 1000 * leg.velocity().length() > rules.maxSpeed();
    }
}
