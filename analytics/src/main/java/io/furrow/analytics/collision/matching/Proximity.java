package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.util.HashMap;
import java.util.Map;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.Thresholds;

/**
 * Decides whether two devices of a cell are close. The squared chord between unit vectors nearly always suffices; within
 * a millionth of the threshold {@link Geodesy#distance} decides, so that the result is that of the definition to the
 * last bit.
 */
public final class Proximity implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final double GUARD_BAND = 1e-6;

    private final Thresholds thresholds;
    private final long maxSkewMillis;
    private final Limit greatest;
    private final double reach;
    /** Limits by types; null if all have one threshold. Grows with the pairs of types that meet. */
    private final Map<String, Map<String, Limit>> limits;

    /** A threshold in meters, and the squared chords outside which the exact distance is not needed. */
    private record Limit(double meters, double surelyClose, double surelyApart) implements Serializable {
        static Limit of(double meters) {
            double chord = 2 * Math.sin(meters / Geodesy.EARTH_RADIUS_METERS / 2);
            return new Limit(meters, chord * chord * (1 - GUARD_BAND), chord * chord * (1 + GUARD_BAND));
        }
    }

    public Proximity(CollisionRules rules) {
        thresholds = rules.thresholds();
        maxSkewMillis =
                rules.maxSkew().isZero() ? Long.MAX_VALUE : rules.maxSkew().toMillis();
        greatest = Limit.of(thresholds.greatest());
        limits = thresholds.ofTypes().isEmpty() ? null : new HashMap<>();
        reach = Math.sqrt(greatest.surelyApart) * (1 + GUARD_BAND);
    }

    /** The greatest chord, in Earth radii, at which two devices can be close. */
    double reach() {
        return reach;
    }

    /** Also excludes two halo copies: they are compared in a cell that is home to one of them. */
    public boolean holds(CellEntry a, CellEntry b) {
        return PairSelection.meet(a, b) && near(a, b);
    }

    /** Whether two devices are close, whatever their home cells. */
    boolean near(CellEntry a, CellEntry b) {
        double squaredChord = squaredChord(a, b);
        return squaredChord <= greatest.surelyApart
                && within(limit(a.fix().type(), b.fix().type()), squaredChord, a, b)
                && Math.abs(a.fix().time() - b.fix().time()) <= maxSkewMillis
                && a.fix().topic().equals(b.fix().topic())
                && !a.fix().sharesAggregateWith(b.fix());
    }

    /** The squared distance of two close devices divided by the square of their threshold. */
    double nearness(CellEntry a, CellEntry b) {
        return squaredChord(a, b) / limit(a.fix().type(), b.fix().type()).surelyApart;
    }

    private static double squaredChord(CellEntry a, CellEntry b) {
        return Geodesy.square(a.x() - b.x()) + Geodesy.square(a.y() - b.y()) + Geodesy.square(a.z() - b.z());
    }

    private static boolean within(Limit limit, double squaredChord, CellEntry a, CellEntry b) {
        return squaredChord < limit.surelyClose
                || squaredChord <= limit.surelyApart && Geodesy.distance(a.fix(), b.fix()) <= limit.meters;
    }

    private Limit limit(String type, String other) {
        return limits == null
                ? greatest
                : limits.computeIfAbsent(type, first -> new HashMap<>())
                        .computeIfAbsent(other, second -> Limit.of(thresholds.between(type, second)));
    }
}
