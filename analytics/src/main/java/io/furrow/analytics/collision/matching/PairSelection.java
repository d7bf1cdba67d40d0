package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Which pairs of a grid cell are followed: all that are close, but for those of crowds. A device that has more than
 * {@code crowd} others near when it reports is in a crowd and makes a {@link NearestNeighbors}. It holds the nearest
 * {@code crowd² / others}, one at least, so that a spot has about as many encounters however many devices crowd there. A
 * device without a shortlist follows all that are close to it.
 *
 * <p>Whether a pair is followed depends on the shortlists and times of both, which change with their own reports only. So
 * does nothing change for a pair of which neither reports.
 */
public final class PairSelection implements Serializable {
    private static final long serialVersionUID = 1L;

    private final Proximity proximity;
    private final int crowd;

    public PairSelection(CollisionRules rules) {
        proximity = new Proximity(rules);
        crowd = rules.cells().isLimited() ? rules.cells().crowd() : Integer.MAX_VALUE;
    }

    Proximity proximity() {
        return proximity;
    }

    /** Whether so many devices can be a crowd. */
    boolean canCrowd(int devices) {
        return devices - 1 > crowd;
    }

    /** How many of this many others a device chooses. */
    int chosenOf(int others) {
        return others <= crowd ? others : (int) Math.max(1, (long) crowd * crowd / others);
    }

    /** Whether two members that are near each other are a pair of this cell. Two halo copies meet elsewhere. */
    static boolean meet(CellEntry a, CellEntry b) {
        return a.resident() || b.resident();
    }

    /** Whether a pair that is close is followed. */
    static boolean follows(CellEntry a, CellEntry b) {
        boolean anyOf = a.shortlist() == null && (b.shortlist() == null || isNotBefore(a, b));
        return anyOf || b.shortlist() == null && isNotBefore(b, a) || a.lists(b) || b.lists(a);
    }

    private static boolean isNotBefore(CellEntry a, CellEntry b) {
        return a.fix().time() >= b.fix().time();
    }

    /**
     * What the member that has just reported goes by from now on; null for all that are close.
     *
     * @param before the same device until then; null if it was not in the cell
     * @param near all that are near it, halo copies of a halo copy too: nobody is a crowd on one side of a border only
     */
    NearestNeighbors shortlist(CellEntry before, CellEntry after, List<CellEntry> near) {
        if (near.size() <= crowd) {
            return null;
        }
        Nearest nearest = new Nearest(chosenOf(near.size()));
        Set<String> listed = new LinkedHashSet<>();
        for (CellEntry other : near) {
            if (meet(after, other)) {
                boolean wasListed = before != null && before.lists(other);
                nearest.offer(other.fix(), proximity.nearness(after, other), wasListed);
                if (before != null && goesOn(before, other)) {
                    listed.add(other.fix().identity());
                }
            }
        }
        listed.addAll(nearest.identities());
        return new NearestNeighbors(List.copyOf(listed));
    }

    /** Whether an encounter with a device without a shortlist continues, which would begin it again with its next report. */
    private boolean goesOn(CellEntry before, CellEntry other) {
        return other.change() == null
                && other.shortlist() == null
                && meet(before, other)
                && proximity.near(before, other)
                && follows(before, other);
    }
}
