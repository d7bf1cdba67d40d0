package io.furrow.analytics.collision.matching;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.CellUpdate;

/**
 * The devices of one grid cell; changed in place. Which pairs are followed follows from where the members are and from the
 * shortlists of those in crowds, and is not stored.
 */
@TypeInfo(CellSerializer.class)
public final class Cell {
    /** Made again for the first member. */
    private CellIndex members = new CellIndex(0);
    /** How many members have a shortlist. */
    private int crowded;
    /** What was last emitted about crowds; null if nothing was within a minute. */
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

    /** How many devices are in the cell, halo copies included. */
    int devices() {
        return members.size();
    }

    Collection<Member> members() {
        return members.all();
    }

    /** Only before the first updates are applied. */
    void put(Member member) {
        crowded += member.shortlist() == null ? 0 : 1;
        members.add(member);
    }

    /** Adds all others to {@code near} that are near a member, at home or not. */
    void near(Member member, Proximity proximity, List<Member> near) {
        prepare(proximity);
        members.near(member, proximity, near);
    }

    /**
     * Applies updates instant by instant and emits what that means for pairs.
     *
     * @param updates in the order of {@link CellUpdate#SEQUENCE}, at most one per device and instant
     * @param out takes the sightings; their order within an instant has no meaning
     */
    public void apply(List<CellUpdate> updates, Matching matching, Consumer<PairObservation> out) {
        int from = 0;
        while (from < updates.size()) {
            int to = endOfInstant(updates, from);
            applyAtOnce(updates.subList(from, to), matching, out);
            from = to;
        }
    }

    /** Applies the updates of one instant. */
    void applyAtOnce(List<CellUpdate> updates, Matching matching, Consumer<PairObservation> out) {
        prepare(matching.proximity());
        putIn(takeOut(updates, matching), matching, updates.get(0).time(), out);
    }

    /** The first update of a later instant than that of the given one. */
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
            List<Member> known = members.all();
            members = new CellIndex(proximity.reach());
            known.forEach(members::add);
        }
    }

    /**
     * A pair whose devices both change is seen once, by the one that comes first in the updates: it leaves before the other,
     * whom it still meets.
     */
    private List<Change> takeOut(List<CellUpdate> updates, Matching matching) {
        List<Change> changes = new ArrayList<>(updates.size());
        for (CellUpdate update : updates) {
            Member before = members.remove(update.fix());
            List<Member> partners = new ArrayList<>();
            if (before != null) {
                crowded -= before.shortlist() == null ? 0 : 1;
                members.partners(before, matching.proximity(), partners);
            }
            changes.add(new Change(changes.size(), before, memberOf(update), partners));
        }
        return changes;
    }

    private void putIn(List<Change> changes, Matching matching, long time, Consumer<PairObservation> out) {
        List<Member> near = new ArrayList<>();
        for (Change change : changes) {
            if (change.after() != null) {
                members.add(change.after());
                change.after().change(change);
            }
        }
        boolean canCrowd = matching.canCrowd(members.size());
        boolean alone = changes.size() == 1;
        for (Change change : canCrowd && !alone ? changes : List.<Change>of()) {
            look(change, matching, near);
            makeShortlist(change, matching, near);
            near.clear();
        }
        for (Change change : changes) {
            look(change, matching, near);
            if (canCrowd && alone) { // one look is enough
                makeShortlist(change, matching, near);
            }
            compare(change, near, time, out);
            near.clear();
        }
        for (Change change : changes) {
            if (change.after() != null) {
                change.after().change(null);
            }
        }
    }

    private void look(Change change, Matching matching, List<Member> near) {
        if (change.after() != null) {
            members.near(change.after(), matching.proximity(), near);
        }
    }

    /** By what was before the instant and where all are now. */
    private void makeShortlist(Change change, Matching matching, List<Member> near) {
        if (change.after() != null) {
            Shortlist shortlist = matching.shortlist(change.before(), change.after(), near);
            change.after().shortlist(shortlist);
            crowded += shortlist == null ? 0 : 1;
        }
    }

    /** Takes a step per partner of before and of now: partners of before are marked, so that nobody has to be looked for. */
    private static void compare(Change change, List<Member> near, long time, Consumer<PairObservation> out) {
        for (Member partner : change.partners()) {
            partner.partnerOf(change);
        }
        for (Member other : near) {
            if (change.comesAfterThatOf(other)
                    || !Matching.meet(change.after(), other)
                    || !Matching.follows(change.after(), other)) {
                continue;
            }
            Member was = other.change() == null ? other : other.change().before();
            boolean wasPartner = was != null && was.partnerOf() == change;
            if (wasPartner) {
                was.partnerOf(null);
            }
            out.accept(PairObservation.of(change.after().fix(), other.fix(), time, wasPartner ? 0 : 1));
        }
        for (Member partner : change.partners()) {
            if (partner.partnerOf() == change) {
                partner.partnerOf(null);
                out.accept(PairObservation.of(change.before().fix(), partner.fix(), time, -1));
            }
        }
    }

    private static Member memberOf(CellUpdate update) {
        return switch (update.presence()) {
            case RESIDENT -> Member.of(update.fix(), true);
            case HALO -> Member.of(update.fix(), false);
            case GONE -> null;
        };
    }
}
