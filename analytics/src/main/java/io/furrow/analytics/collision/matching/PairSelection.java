package io.furrow.analytics.collision.matching;

import java.io.Serializable;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * Decides which close pairs of a grid cell are followed: all, except in crowds. A device with more than {@code crowd} others
 * near when it reports is in a crowd and gets a shortlist, {@link NearestNeighbors}, of the nearest {@code crowd² / others},
 * at least one, so that a spot has about as many encounters however many devices crowd there. A device without a shortlist
 * follows all that are close to it.
 *
 * <p>Whether a pair is followed depends on the shortlists and times of both, which change with their own reports only.
 * Nothing changes, therefore, for a pair of which neither reports.
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

    /** Whether this number of devices can be a crowd. */
    boolean canCrowd(int devices) {
        return devices - 1 > crowd;
    }

    /** The number of devices followed out of this many others. */
    int chosenOf(int others) {
        return others <= crowd ? others : (int) Math.max(1, (long) crowd * crowd / others);
    }

    /** Whether two members that are near each other are a pair of this cell. Two halo copies meet in another. */
    static boolean meet(CellEntry a, CellEntry b) {
        return a.resident() || b.resident();
    }

    /** Whether a close pair is followed. */
    static boolean follows(CellEntry a, CellEntry b) {
        boolean anyOf = a.shortlist() == null && (b.shortlist() == null || isNotBefore(a, b));
        return anyOf || b.shortlist() == null && isNotBefore(b, a) || a.lists(b) || b.lists(a);
    }

    private static boolean isNotBefore(CellEntry a, CellEntry b) {
        return a.fix().time() >= b.fix().time();
    }

    /**
     * The new shortlist of the member that has just reported; null to follow all close devices.
     *
     * @param before the device's previous entry; null if it was not in the cell
     * @param near all members near it, also halo copies near a halo copy: a crowd is the same on both sides of a border
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

    /** Whether an encounter with a device without a shortlist continues; its next report would start it again. */
    private boolean goesOn(CellEntry before, CellEntry other) {
        return other.change() == null
                && other.shortlist() == null
                && meet(before, other)
                && proximity.near(before, other)
                && follows(before, other);
    }
}
