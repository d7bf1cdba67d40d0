package io.furrow.analytics.collision;

import java.io.Serializable;

/**
 * Whether two devices of a cell are close. The squared chord between unit vectors answers nearly always; within a
 * millionth of the threshold's own {@link Geodesy#distance} decides, so that the answer is that of the definition to the
 * last bit.
 */
final class Proximity implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final double GUARD_BAND = 1e-6;

    private final double threshold;
    private final long maxSkewMillis;
    private final double surelyClose;
    private final double surelyApart;

    Proximity(CollisionRules rules) {
        threshold = rules.thresholdMeters();
        maxSkewMillis =
                rules.maxSkew().isZero() ? Long.MAX_VALUE : rules.maxSkew().toMillis();
        double chord = 2 * Math.sin(threshold / Geodesy.EARTH_RADIUS_METERS / 2);
        surelyClose = chord * chord * (1 - GUARD_BAND);
        surelyApart = chord * chord * (1 + GUARD_BAND);
    }

    /** Two halo copies are not compared here: they meet in a cell where one of them is at home. */
    boolean holds(Member a, Member b) {
        double squaredChord =
                Geodesy.square(a.x() - b.x()) + Geodesy.square(a.y() - b.y()) + Geodesy.square(a.z() - b.z());
        if (squaredChord > surelyApart || !a.resident() && !b.resident()) {
            return false;
        }
        return (squaredChord < surelyClose || Geodesy.distance(a.fix(), b.fix()) <= threshold)
                && Math.abs(a.fix().time() - b.fix().time()) <= maxSkewMillis
                && !a.fix().sharesAggregateWith(b.fix());
    }
}
