package io.furrow.analytics.collision;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;

/**
 * Limits how many pairs of a grid cell are followed. A pair that is followed stays so until it is close no more or leaves the
 * cell; what ends at an instant makes room first; then the pairs that are seen at that instant and not followed come in, in
 * the order of their names, while there is room. A pair that found none tries again whenever either device reports. Which
 * pairs are followed therefore is a function of the accepted positions and the grid.
 */
final class PairLimit implements Serializable {
    private static final long serialVersionUID = 1L;

    private static final Comparator<Sighting> BY_NAME = Comparator.comparing(Sighting::first, PositionFix.NAMING)
            .thenComparing(Sighting::second, PositionFix.NAMING);

    private final int limit;
    private final long reportEvery;

    PairLimit(CollisionRules rules) {
        limit = rules.cells().pairLimit();
        reportEvery = rules.ongoingEvery().toMillis();
    }

    boolean isNone() {
        return limit == 0;
    }

    /** Takes what the limit leaves. */
    interface Output {
        void sighting(Sighting sighting);

        /** To be told: the crowd at an instant at which the limit left pairs out, or no more. */
        void overflow(Crowd crowd, Sighting cause);

        /** A pair became close and is not followed. */
        void leftOut();
    }

    /**
     * @param before null where no pair is close
     * @param seen what is seen of pairs of one cell at one instant, as if there were no limit; in any order
     * @return null where no pair is close any more
     */
    Crowd apply(Crowd before, List<Sighting> seen, Output out) {
        if (seen.isEmpty()) {
            return before;
        }
        List<Sighting> sightings = new ArrayList<>(seen);
        sightings.sort(BY_NAME);
        Crowd crowd = before == null ? new Crowd(new HashSet<>(), 0, false, 0) : before;
        int close = crowd.close() + followed(crowd, sightings, out);
        Crowd now = told(new Crowd(crowd.kept(), close, crowd.over(), crowd.reported()), sightings.get(0), out);
        return now.isEmpty() ? null : now;
    }

    /** Changes which pairs are kept; returns by how many more pairs are close. */
    private int followed(Crowd crowd, List<Sighting> sightings, Output out) {
        int change = 0;
        List<Sighting> candidates = new ArrayList<>();
        for (Sighting sighting : sightings) {
            change += sighting.change();
            Pair pair = sighting.pair();
            boolean kept = sighting.change() < 0
                    ? crowd.kept().remove(pair)
                    : crowd.kept().contains(pair);
            if (kept) {
                out.sighting(sighting);
            } else if (sighting.change() >= 0) {
                candidates.add(sighting);
            }
        }
        for (Sighting candidate : candidates) {
            if (crowd.kept().size() < limit) {
                crowd.kept().add(candidate.pair());
                out.sighting(new Sighting(candidate.first(), candidate.second(), candidate.time(), 1));
            } else if (candidate.change() > 0) {
                out.leftOut();
            }
        }
        return change;
    }

    private Crowd told(Crowd crowd, Sighting cause, Output out) {
        boolean over = crowd.leftOut() > 0;
        boolean rested = !crowd.over() || cause.time() - crowd.reported() >= reportEvery;
        if (over ? !rested : !crowd.over()) {
            return crowd;
        }
        Crowd told = new Crowd(crowd.kept(), crowd.close(), over, cause.time());
        out.overflow(told, cause);
        return told;
    }
}
