package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * The devices of one grid cell; changed in place. Which pairs are close follows from where the members are and is not
 * stored.
 */
@TypeInfo(CellFormat.class)
public final class Cell {
    /** Made again where there are none, or for another threshold. */
    private Members members = new Members(0);
    /** Only where the number of pairs is limited; null while none is close. */
    private Crowd crowd;

    private Cell() {}

    /** What happens to one device at one instant; null where it is not in the cell. */
    private record Change(Member before, Member after, List<Member> partners) {}

    public static Cell empty() {
        return new Cell();
    }

    boolean isEmpty() {
        return members.size() == 0 && crowd == null;
    }

    Crowd crowd() {
        return crowd;
    }

    void crowd(Crowd now) {
        crowd = now;
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
        members.add(member);
    }

    /**
     * Applies updates instant by instant and tells what that means for pairs.
     *
     * @param updates in the order of {@link CellUpdate#SEQUENCE}, at most one per device and instant
     * @param out takes the sightings; their order within an instant has no meaning
     */
    public void apply(List<CellUpdate> updates, Proximity proximity, Consumer<Sighting> out) {
        if (members.reach() != proximity.reach()) {
            List<Member> known = members.all();
            members = new Members(proximity.reach());
            known.forEach(members::add);
        }
        int from = 0;
        while (from < updates.size()) {
            long time = updates.get(from).time();
            int to = from + 1;
            while (to < updates.size() && updates.get(to).time() == time) {
                to++;
            }
            applyAtOnce(updates.subList(from, to), proximity, out);
            from = to;
        }
    }

    /**
     * A pair whose devices both change is seen once, by the one that comes first in the updates: it leaves before the other,
     * whom it still meets, and comes back after it.
     */
    private void applyAtOnce(List<CellUpdate> updates, Proximity proximity, Consumer<Sighting> out) {
        List<Change> changes = new ArrayList<>(updates.size());
        for (CellUpdate update : updates) {
            Member before = members.remove(update.fix());
            List<Member> partners = new ArrayList<>();
            if (before != null) {
                members.closeTo(before, proximity, partners);
            }
            changes.add(new Change(before, memberOf(update), partners));
        }
        List<Member> met = new ArrayList<>();
        for (int i = changes.size() - 1; i >= 0; i--) {
            Change change = changes.get(i);
            long time = updates.get(i).time();
            if (change.after != null) {
                members.closeTo(change.after, proximity, met);
                for (Member other : met) {
                    out.accept(Sighting.of(change.after.fix(), other.fix(), time, wasMet(change, other) ? 0 : 1));
                }
                met.clear();
                members.add(change.after);
            }
            for (Member other : change.partners) {
                out.accept(Sighting.of(change.before.fix(), other.fix(), time, -1));
            }
        }
    }

    private static boolean wasMet(Change change, Member other) {
        return change.partners.removeIf(partner -> partner.fix().isOfSameDevice(other.fix()));
    }

    private static Member memberOf(CellUpdate update) {
        return switch (update.presence()) {
            case RESIDENT -> Member.of(update.fix(), true);
            case HALO -> Member.of(update.fix(), false);
            case GONE -> null;
        };
    }
}
