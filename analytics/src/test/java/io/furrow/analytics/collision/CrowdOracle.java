package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.function.BiPredicate;

import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/** What crowds leave out, as a definition: the shortlists of all devices of all cells, made from scratch at each report. */
final class CrowdOracle {
    private static final long MINUTE = 60_000;

    private final CollisionRules rules;
    private final Grid grid;
    private final BiPredicate<PositionFix, PositionFix> close;
    private final List<CollisionOracle.Overflow> overflows = new ArrayList<>();
    private final Map<Long, CollisionOracle.Overflow> told = new HashMap<>();
    private TreeMap<Long, Map<String, Standing>> cells = new TreeMap<>();

    /** A device in a cell; without a shortlist it follows all that are close. */
    private record Standing(PositionFix fix, boolean home, Set<String> shortlist) {
        boolean isCrowded() {
            return shortlist != null;
        }

        boolean wants(Standing other) {
            return isCrowded()
                    ? shortlist.contains(other.fix.identity())
                    : !other.isCrowded() || fix.time() >= other.fix.time();
        }

        boolean isFollowedWith(Standing other) {
            return wants(other) || other.wants(this);
        }
    }

    /** @param close by the definition, and without regard to crowds */
    CrowdOracle(CollisionRules rules, Grid grid, BiPredicate<PositionFix, PositionFix> close) {
        this.rules = rules;
        this.grid = grid;
        this.close = close;
    }

    /** @param last the positions that count at an instant */
    void evaluate(List<PositionFix> last, long t) {
        tellUntil(t - 1);
        TreeMap<Long, Map<String, Standing>> before = cells;
        TreeMap<Long, Map<String, Standing>> now = new TreeMap<>();
        for (PositionFix fix : last) {
            long[] of = grid.cells(fix.latitude(), fix.longitude());
            for (long cell : of) {
                Standing known = before.getOrDefault(cell, Map.of()).get(fix.identity());
                now.computeIfAbsent(cell, id -> new TreeMap<>())
                        .put(fix.identity(), fix.time() == t ? new Standing(fix, cell == of[0], null) : known);
            }
        }
        cells = new TreeMap<>();
        now.forEach((cell, members) -> {
            Map<String, Standing> settled = new TreeMap<>();
            members.forEach((identity, each) -> settled.put(
                    identity,
                    each.fix.time() == t ? reported(each, members, before.getOrDefault(cell, Map.of()), t) : each));
            cells.put(cell, settled);
        });
        tellUntil(t);
        cells.forEach((cell, members) -> {
            if (!told.containsKey(cell) && members.values().stream().anyMatch(Standing::isCrowded)) {
                tell(cell, t);
            }
        });
    }

    /** Whether a close pair has an encounter. */
    boolean isFollowed(long cell, PositionFix a, PositionFix b) {
        Map<String, Standing> members = cells.get(cell);
        return members.get(a.identity()).isFollowedWith(members.get(b.identity()));
    }

    List<CollisionOracle.Overflow> overflows() {
        tellUntil(Long.MAX_VALUE);
        return overflows;
    }

    private Standing reported(Standing device, Map<String, Standing> members, Map<String, Standing> before, long t) {
        List<Standing> near = members.values().stream()
                .filter(other -> other != device && close.test(device.fix, other.fix))
                .toList();
        int crowd = rules.cells().crowd();
        if (crowd == 0 || near.size() <= crowd) {
            return device;
        }
        Standing was = before.get(device.fix.identity());
        Set<String> known = was == null || was.shortlist == null ? Set.of() : was.shortlist;
        Set<String> shortlist = new HashSet<>();
        Comparator<PositionFix> order = Comparator.<PositionFix>comparingInt(other -> quarter(device.fix, other))
                .thenComparing(other -> !known.contains(other.identity()))
                .thenComparing(other -> Geodesy.distance(device.fix, other) / threshold(device.fix, other))
                .thenComparing(PositionFix.NAMING);
        near.stream()
                .filter(other -> device.home || other.home)
                .map(Standing::fix)
                .sorted(order)
                .limit(Math.max(1, crowd * crowd / near.size()))
                .forEach(other -> shortlist.add(other.identity()));
        for (Standing other : near) {
            boolean goesOn = was != null
                    && other.fix.time() < t
                    && !other.isCrowded()
                    && (was.home || other.home)
                    && close.test(was.fix, other.fix)
                    && was.isFollowedWith(other);
            if (goesOn && (device.home || other.home)) {
                shortlist.add(other.fix.identity());
            }
        }
        return new Standing(device.fix, device.home, shortlist);
    }

    private int quarter(PositionFix a, PositionFix b) {
        int quarter = 0;
        while (quarter < 3 && Geodesy.distance(a, b) > threshold(a, b) * (quarter + 1) / 4) {
            quarter++;
        }
        return quarter;
    }

    private double threshold(PositionFix a, PositionFix b) {
        return rules.thresholds().between(a.type(), b.type())
                * rules.steadiness().leaveFactor();
    }

    private void tellUntil(long until) {
        for (long cell : List.copyOf(told.keySet())) {
            while (told.containsKey(cell) && told.get(cell).time() + MINUTE <= until) {
                CollisionOracle.Overflow newest = told.get(cell);
                if (newest.crowded() || isCrowded(cell)) {
                    tell(cell, newest.time() + MINUTE);
                } else {
                    told.remove(cell);
                }
            }
        }
    }

    private boolean isCrowded(long cell) {
        return cells.getOrDefault(cell, Map.of()).values().stream().anyMatch(Standing::isCrowded);
    }

    private void tell(long cell, long time) {
        List<Standing> members = List.copyOf(cells.getOrDefault(cell, Map.of()).values());
        int pairs = 0;
        int leftOut = 0;
        for (int i = 0; i < members.size(); i++) {
            for (Standing other : members.subList(i + 1, members.size())) {
                Standing one = members.get(i);
                if ((one.home || other.home) && close.test(one.fix, other.fix)) {
                    pairs++;
                    leftOut += one.isFollowedWith(other) ? 0 : 1;
                }
            }
        }
        var now = new CollisionOracle.Overflow(cell, time, members.size(), pairs, leftOut, isCrowded(cell));
        overflows.add(now);
        told.put(cell, now);
    }
}
