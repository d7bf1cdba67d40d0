package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Collectors;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/** The definition of this package as code: every pair at every instant, nothing clever. */
public final class CollisionOracle {
    /** The order in which results are compared; a pair has one record per instant at most. */
    public static final Comparator<Encounter> ORDER = Comparator.comparingLong(Encounter::time)
            .thenComparing(encounter -> encounter.first().identity())
            .thenComparing(encounter -> encounter.second().identity());

    private final CollisionRules rules;
    private final Grid grid;
    private final TreeMap<String, List<PositionFix>> devices;
    private final Map<Pair, Seen> close = new HashMap<>();
    private final Map<Pair, List<Seen>> open = new HashMap<>();
    private final CrowdOracle crowds;
    private final List<Encounter> encounters = new ArrayList<>();

    /** A close pair at an instant, and the cell in which it is found. */
    private record Seen(PositionFix first, PositionFix second, double distance, long cell, long time) {
        boolean isNew() {
            return first.time() == time || second.time() == time;
        }
    }

    /** What is reported of a cell with a crowd, or without one any more. */
    public record Overflow(long cell, long time, int devices, long pairs, long leftOut, boolean crowded) {
        public static final Comparator<Overflow> ORDER =
                Comparator.comparingLong(Overflow::time).thenComparingLong(Overflow::cell);

        /** Whether one is there is not told: it is known from what follows. */
        static Overflow of(CellOverflow told) {
            return new Overflow(told.cell(), told.time(), told.devices(), told.pairs(), told.pairsLeftOut(), false);
        }

        Overflow asTold() {
            return new Overflow(cell, time, devices, pairs, leftOut, false);
        }
    }

    /** In their orders. */
    public record Result(List<Encounter> encounters, List<Overflow> overflows) {}

    private CollisionOracle(Collection<PositionFix> accepted, CollisionRules rules) {
        this.rules = rules;
        this.grid = new Grid(rules.exact());
        this.crowds = new CrowdOracle(rules, grid, this::isClose);
        this.devices = accepted.stream()
                .collect(Collectors.groupingBy(PositionFix::identity, TreeMap::new, Collectors.toList()));
    }

    public static List<Encounter> encounters(Collection<PositionFix> accepted, CollisionRules rules) {
        return result(accepted, rules).encounters();
    }

    public static Result result(Collection<PositionFix> accepted, CollisionRules rules) {
        CollisionOracle oracle = new CollisionOracle(accepted, rules);
        TreeSet<Long> instants = new TreeSet<>();
        for (PositionFix fix : accepted) {
            instants.add(fix.time());
            instants.add(fix.time() + rules.timeToLive().toMillis());
        }
        instants.forEach(oracle::evaluate);
        oracle.encounters.sort(ORDER);
        List<Overflow> overflows = oracle.crowds.overflows().stream()
                .map(Overflow::asTold)
                .sorted(Overflow.ORDER)
                .toList();
        return new Result(oracle.encounters, overflows);
    }

    /** The first records in which two sorted results differ; few, because a failing test prints them. */
    public static <T> List<T> difference(List<T> some, List<T> others) {
        int at = 0;
        while (at < Math.min(some.size(), others.size()) && some.get(at).equals(others.get(at))) {
            at++;
        }
        List<T> found = new ArrayList<>();
        found.addAll(some.subList(at, Math.min(at + 2, some.size())));
        found.addAll(others.subList(at, Math.min(at + 2, others.size())));
        return found;
    }

    private void evaluate(long t) {
        close.clear();
        List<PositionFix> last = devices.values().stream()
                .flatMap(fixes -> last(fixes, t).stream())
                .sorted(PositionFix.NAMING)
                .toList();
        for (int i = 0; i < last.size(); i++) {
            for (PositionFix other : last.subList(i + 1, last.size())) {
                closeAt(last.get(i), other, t).ifPresent(seen -> close.put(Pair.of(seen.first, seen.second), seen));
            }
        }
        crowds.evaluate(last, t);
        Set<Pair> followed = followed();
        for (Pair pair : Set.copyOf(open.keySet())) {
            if (!followed.contains(pair)) {
                tell(open.remove(pair), t);
            }
        }
        for (Pair pair : followed) {
            Seen seen = close.get(pair);
            if (seen.isNew() || !open.containsKey(pair)) {
                open.computeIfAbsent(pair, key -> new ArrayList<>()).add(seen);
            }
        }
    }

    /** The last position counts if it is not too old and in no zone. */
    private Optional<PositionFix> last(List<PositionFix> fixes, long t) {
        return fixes.stream()
                .filter(fix -> fix.time() <= t)
                .max(PositionFix.SEQUENCE)
                .filter(fix -> t < fix.time() + rules.timeToLive().toMillis())
                .filter(fix -> !rules.positions().zones().cover(fix.latitude(), fix.longitude()));
    }

    private Optional<Seen> closeAt(PositionFix a, PositionFix b, long t) {
        long cell = Math.max(grid.cells(a.latitude(), a.longitude())[0], grid.cells(b.latitude(), b.longitude())[0]);
        return isClose(a, b) ? Optional.of(new Seen(a, b, Geodesy.distance(a, b), cell, t)) : Optional.empty();
    }

    private boolean isClose(PositionFix a, PositionFix b) {
        boolean inTime = rules.maxSkew().isZero()
                || Math.abs(a.time() - b.time()) <= rules.maxSkew().toMillis();
        boolean together = a.identity().equals(b.carrier())
                || b.identity().equals(a.carrier())
                || !a.carrier().isEmpty() && a.carrier().equals(b.carrier());
        double threshold = rules.thresholds().between(a.type(), b.type())
                * rules.steadiness().leaveFactor();
        return Geodesy.distance(a, b) <= threshold && inTime && !together;
    }

    /** All close pairs but what crowds leave out. */
    private Set<Pair> followed() {
        return close.values().stream()
                .filter(seen -> crowds.isFollowed(seen.cell, seen.first, seen.second))
                .map(seen -> Pair.of(seen.first, seen.second))
                .collect(Collectors.toSet());
    }

    /** A stretch of time in which a pair is close, from its first instant; {@code end} is the first after it. */
    private void tell(List<Seen> stretch, long end) {
        PositionFix one = stretch.get(0).first;
        double threshold =
                rules.thresholds().between(one.type(), stretch.get(0).second.type());
        List<Seen> observations =
                stretch.stream().dropWhile(seen -> seen.distance > threshold).toList();
        if (observations.isEmpty()) {
            return;
        }
        long start = observations.get(0).time;
        long due = start + rules.steadiness().dwell().toMillis();
        if (end <= due) {
            return;
        }
        long reported = due;
        double closest = Double.POSITIVE_INFINITY;
        Seen newest = null;
        for (Seen seen : observations) {
            if (seen.time > due && newest.time <= due) {
                encounters.add(record(Phase.STARTED, newest, closest, start, due));
            }
            newest = seen;
            closest = Math.min(closest, seen.distance);
            if (seen.time > due && seen.time - reported >= rules.ongoingEvery().toMillis()) {
                encounters.add(record(Phase.ONGOING, seen, closest, start, seen.time));
                reported = seen.time;
            }
        }
        if (newest.time <= due) {
            encounters.add(record(Phase.STARTED, newest, closest, start, due));
        }
        encounters.add(record(Phase.ENDED, newest, closest, start, end));
    }

    private static Encounter record(Phase phase, Seen seen, double closest, long start, long time) {
        return new Encounter(phase, seen.first, seen.second, seen.distance, closest, start, time);
    }
}
