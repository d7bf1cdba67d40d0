package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.util.HashMap;
import java.util.Map;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.Thresholds;

/**
 * Whether two devices of a cell are close. The squared chord between unit vectors answers nearly always; within a
 * millionth of the threshold's own {@link Geodesy#distance} decides, so that the answer is that of the definition to the
 * last bit.
 */
public final class Proximity implements Serializable {
    private static final long serialVersionUID = 1L;
    private static final double GUARD_BAND = 1e-6;

    private final Thresholds thresholds;
    private final long maxSkewMillis;
    private final Limit greatest;
    private final double reach;
    /** By types; null if all have one threshold. Grows with the pairs of types that are met. */
    private final Map<String, Map<String, Limit>> limits;

    /** A threshold in meters, and the squared chords below and above which it need not be asked. */
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

    /** Two halo copies are not compared here: they meet in a cell where one of them is at home. */
    public boolean holds(CellEntry a, CellEntry b) {
        return PairSelection.meet(a, b) && near(a, b);
    }

    /** Whether two devices are close, wherever they are at home. */
    boolean near(CellEntry a, CellEntry b) {
        double squaredChord = squaredChord(a, b);
        return squaredChord <= greatest.surelyApart
                && within(limit(a.fix().type(), b.fix().type()), squaredChord, a, b)
                && Math.abs(a.fix().time() - b.fix().time()) <= maxSkewMillis
                && a.fix().topic().equals(b.fix().topic())
                && !a.fix().sharesAggregateWith(b.fix());
    }

    /** Of two close devices the square of their distance, as a share of that of their threshold. */
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
