package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/**
 * The devices of one grid cell. Which pairs are close follows from where the members are and is not stored.
 *
 * @param members by identity; changed in place
 */
public record Cell(Map<String, Member> members) {
    /** What happens to one device at one instant; null where it is not in the cell. */
    private record Change(Member before, Member after) {}

    static Cell empty() {
        return new Cell(new HashMap<>());
    }

    boolean isEmpty() {
        return members.isEmpty();
    }

    /** How many devices are in the cell, halo copies included. */
    int devices() {
        return members.size();
    }

    /**
     * Applies updates instant by instant and tells what that means for pairs.
     *
     * @param updates in the order of {@link CellUpdate#SEQUENCE}, at most one per device and instant
     * @param out takes the sightings; their order within an instant has no meaning
     */
    void apply(List<CellUpdate> updates, Proximity proximity, Consumer<Sighting> out) {
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

    private void applyAtOnce(List<CellUpdate> updates, Proximity proximity, Consumer<Sighting> out) {
        long time = updates.get(0).time();
        List<Change> changes = new ArrayList<>(updates.size());
        for (CellUpdate update : updates) {
            changes.add(new Change(members.remove(update.fix().identity()), memberOf(update)));
        }
        // Only those who did not change are members now, so no pair is compared twice.
        for (int i = 0; i < changes.size(); i++) {
            Change change = changes.get(i);
            for (Member unchanged : members.values()) {
                compare(change, new Change(unchanged, unchanged), time, proximity, out);
            }
            for (Change other : changes.subList(i + 1, changes.size())) {
                compare(change, other, time, proximity, out);
            }
        }
        for (Change change : changes) {
            if (change.after != null) {
                members.put(change.after.fix().identity(), change.after);
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

    private static void compare(Change one, Change other, long time, Proximity proximity, Consumer<Sighting> out) {
        boolean were = one.before != null && other.before != null && proximity.holds(one.before, other.before);
        boolean are = one.after != null && other.after != null && proximity.holds(one.after, other.after);
        if (are) {
            out.accept(Sighting.of(one.after.fix(), other.after.fix(), time, were ? 0 : 1));
        } else if (were) {
            out.accept(Sighting.of(one.before.fix(), other.before.fix(), time, -1));
        }
    }
}
