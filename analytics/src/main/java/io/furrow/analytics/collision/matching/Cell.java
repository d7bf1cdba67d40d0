package io.furrow.analytics.collision.matching;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.CellUpdate;

/**
 * The devices of one grid cell; changed in place. Which pairs are followed results from the positions and the shortlists of
 * its members and is not stored.
 */
@TypeInfo(CellSerializer.class)
public final class Cell {
    /** Recreated for the first member. */
    private CellIndex members = new CellIndex(0);
    /** Number of members with a shortlist. */
    private int crowded;
    /** The last report about crowds; null if there was none within a minute. */
    private CrowdReport report;

    private Cell() {}

    public static Cell empty() {
        return new Cell();
    }

    public boolean isEmpty() {
        return members.size() == 0 && report == null;
    }

    boolean isCrowded() {
        return crowded > 0;
    }

    CrowdReport report() {
        return report;
    }

    void report(CrowdReport now) {
        report = now;
    }

    /** Number of devices in the cell, halo copies included. */
    int devices() {
        return members.size();
    }

    Collection<CellEntry> members() {
        return members.all();
    }

    /** May only be called before the first updates are applied. */
    void put(CellEntry cellEntry) {
        crowded += cellEntry.shortlist() == null ? 0 : 1;
        members.add(cellEntry);
    }

    /** Adds all other devices near a member to {@code near}, resident or not. */
    void near(CellEntry cellEntry, Proximity proximity, List<CellEntry> near) {
        prepare(proximity);
        members.near(cellEntry, proximity, near);
    }

    /**
     * Applies updates instant by instant and emits the resulting observations of pairs.
     *
     * @param updates in the order of {@link CellUpdate#SEQUENCE}, at most one per device and instant
     * @param out receives the observations; their order within an instant has no meaning
     */
    public void apply(List<CellUpdate> updates, PairSelection pairSelection, Consumer<PairObservation> out) {
        int from = 0;
        while (from < updates.size()) {
            int to = endOfInstant(updates, from);
            applyAtOnce(updates.subList(from, to), pairSelection, out);
            from = to;
        }
    }

    /** Applies the updates of one instant. */
    void applyAtOnce(List<CellUpdate> updates, PairSelection pairSelection, Consumer<PairObservation> out) {
        prepare(pairSelection.proximity());
        putIn(takeOut(updates, pairSelection), pairSelection, updates.get(0).time(), out);
    }

    /** The index of the first update that is later than the given one. */
    public static int endOfInstant(List<CellUpdate> updates, int from) {
        int to = from + 1;
        while (to < updates.size()
                && updates.get(to).time() == updates.get(from).time()) {
            to++;
        }
        return to;
    }

    private void prepare(Proximity proximity) {
        if (members.reach() != proximity.reach()) {
            List<CellEntry> known = members.all();
            members = new CellIndex(proximity.reach());
            known.forEach(members::add);
        }
    }

    /**
     * Removes the devices that change. A pair whose devices both change is observed once, by the one first in the updates:
     * it is removed before the other, which is then still present.
     */
    private List<CellChange> takeOut(List<CellUpdate> updates, PairSelection pairSelection) {
        List<CellChange> changes = new ArrayList<>(updates.size());
        for (CellUpdate update : updates) {
            CellEntry before = members.remove(update.fix());
            List<CellEntry> partners = new ArrayList<>();
            if (before != null) {
                crowded -= before.shortlist() == null ? 0 : 1;
                members.partners(before, pairSelection.proximity(), partners);
            }
            changes.add(new CellChange(changes.size(), before, memberOf(update), partners));
        }
        return changes;
    }

    private void putIn(
            List<CellChange> changes, PairSelection pairSelection, long time, Consumer<PairObservation> out) {
        List<CellEntry> near = new ArrayList<>();
        for (CellChange cellChange : changes) {
            if (cellChange.after() != null) {
                members.add(cellChange.after());
                cellChange.after().change(cellChange);
            }
        }
        boolean canCrowd = pairSelection.canCrowd(members.size());
        boolean alone = changes.size() == 1;
        for (CellChange cellChange : canCrowd && !alone ? changes : List.<CellChange>of()) {
            look(cellChange, pairSelection, near);
            makeShortlist(cellChange, pairSelection, near);
            near.clear();
        }
        for (CellChange cellChange : changes) {
            look(cellChange, pairSelection, near);
            if (canCrowd && alone) { // one search is enough
                makeShortlist(cellChange, pairSelection, near);
            }
            compare(cellChange, near, time, out);
            near.clear();
        }
        for (CellChange cellChange : changes) {
            if (cellChange.after() != null) {
                cellChange.after().change(null);
            }
        }
    }

    private void look(CellChange cellChange, PairSelection pairSelection, List<CellEntry> near) {
        if (cellChange.after() != null) {
            members.near(cellChange.after(), pairSelection.proximity(), near);
        }
    }

    /** From the positions before the instant and those after it. */
    private void makeShortlist(CellChange cellChange, PairSelection pairSelection, List<CellEntry> near) {
        if (cellChange.after() != null) {
            NearestNeighbors nearestNeighbors = pairSelection.shortlist(cellChange.before(), cellChange.after(), near);
            cellChange.after().shortlist(nearestNeighbors);
            crowded += nearestNeighbors == null ? 0 : 1;
        }
    }

    /** Takes a step per former and current partner: former partners are marked, so that no search is needed. */
    private static void compare(CellChange cellChange, List<CellEntry> near, long time, Consumer<PairObservation> out) {
        for (CellEntry partner : cellChange.partners()) {
            partner.partnerOf(cellChange);
        }
        for (CellEntry other : near) {
            if (cellChange.comesAfterThatOf(other)
                    || !PairSelection.meet(cellChange.after(), other)
                    || !PairSelection.follows(cellChange.after(), other)) {
                continue;
            }
            CellEntry was = other.change() == null ? other : other.change().before();
            boolean wasPartner = was != null && was.partnerOf() == cellChange;
            if (wasPartner) {
                was.partnerOf(null);
            }
            out.accept(PairObservation.of(cellChange.after().fix(), other.fix(), time, wasPartner ? 0 : 1));
        }
        for (CellEntry partner : cellChange.partners()) {
            if (partner.partnerOf() == cellChange) {
                partner.partnerOf(null);
                out.accept(PairObservation.of(cellChange.before().fix(), partner.fix(), time, -1));
            }
        }
    }

    private static CellEntry memberOf(CellUpdate update) {
        return switch (update.cellPresence()) {
            case RESIDENT -> CellEntry.of(update.fix(), true);
            case HALO -> CellEntry.of(update.fix(), false);
            case GONE -> null;
        };
    }
}
