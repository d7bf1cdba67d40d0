package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Collectors;

/** The definition of this package as code: every pair at every instant, nothing clever. */
final class CollisionOracle {
    /** The order in which results are compared; a pair has one record per instant at most. */
    static final Comparator<Encounter> ORDER = Comparator.comparingLong(Encounter::time)
            .thenComparing(encounter -> encounter.first().identity())
            .thenComparing(encounter -> encounter.second().identity());

    private final CollisionRules rules;
    private final TreeMap<String, List<PositionFix>> devices;
    private final Map<String, Open> open = new HashMap<>();
    private final List<Encounter> encounters = new ArrayList<>();

    /** An encounter that has not ended, with its newest record. */
    private record Open(Encounter seen, long reported) {}

    private CollisionOracle(Collection<PositionFix> accepted, CollisionRules rules) {
        this.rules = rules;
        this.devices = accepted.stream()
                .collect(Collectors.groupingBy(PositionFix::identity, TreeMap::new, Collectors.toList()));
    }

    static List<Encounter> encounters(Collection<PositionFix> accepted, CollisionRules rules) {
        CollisionOracle oracle = new CollisionOracle(accepted, rules);
        TreeSet<Long> instants = new TreeSet<>();
        for (PositionFix fix : accepted) {
            instants.add(fix.time());
            instants.add(fix.time() + rules.timeToLive().toMillis());
        }
        instants.forEach(oracle::evaluate);
        oracle.encounters.sort(ORDER);
        return oracle.encounters;
    }

    /** The first records in which two sorted results differ; few, because a failing test prints them. */
    static List<Encounter> difference(List<Encounter> some, List<Encounter> others) {
        int at = 0;
        while (at < Math.min(some.size(), others.size()) && some.get(at).equals(others.get(at))) {
            at++;
        }
        List<Encounter> found = new ArrayList<>();
        found.addAll(some.subList(at, Math.min(at + 2, some.size())));
        found.addAll(others.subList(at, Math.min(at + 2, others.size())));
        return found;
    }

    private void evaluate(long t) {
        Map<String, PositionFix> last = new TreeMap<>();
        devices.forEach((identity, fixes) -> last(fixes, t).ifPresent(fix -> last.put(identity, fix)));
        for (String one : devices.keySet()) {
            for (String other : devices.tailMap(one, false).keySet()) {
                evaluate(one + " " + other, last.get(one), last.get(other), t);
            }
        }
    }

    private Optional<PositionFix> last(List<PositionFix> fixes, long t) {
        return fixes.stream()
                .filter(fix -> fix.time() <= t)
                .max(PositionFix.SEQUENCE)
                .filter(fix -> t < fix.time() + rules.timeToLive().toMillis());
    }

    private void evaluate(String pair, PositionFix one, PositionFix other, long t) {
        boolean close = one != null && other != null && close(one, other);
        Open before = open.get(pair);
        if (!close) {
            if (before != null) {
                encounters.add(record(Phase.ENDED, before.seen, before.seen.minDistance(), t));
                open.remove(pair);
            }
            return;
        }
        Encounter here = ordered(one, other, t);
        if (before == null) {
            encounters.add(here);
            open.put(pair, new Open(here, t));
        } else if (one.time() == t || other.time() == t) {
            double closest = Math.min(before.seen.minDistance(), here.distance());
            Encounter there = new Encounter(
                    Phase.ONGOING, here.first(), here.second(), here.distance(), closest, before.seen.startTime(), t);
            boolean report = t - before.reported >= rules.ongoingEvery().toMillis();
            if (report) {
                encounters.add(there);
            }
            open.put(pair, new Open(there, report ? t : before.reported));
        }
    }

    private boolean close(PositionFix a, PositionFix b) {
        boolean inTime = rules.maxSkew().isZero()
                || Math.abs(a.time() - b.time()) <= rules.maxSkew().toMillis();
        boolean together = a.identity().equals(b.carrier())
                || b.identity().equals(a.carrier())
                || !a.carrier().isEmpty() && a.carrier().equals(b.carrier());
        return Geodesy.distance(a, b) <= rules.thresholdMeters() && inTime && !together;
    }

    private static Encounter ordered(PositionFix one, PositionFix other, long t) {
        int byId = one.id().compareTo(other.id());
        boolean inOrder = byId < 0 || byId == 0 && one.identity().compareTo(other.identity()) < 0;
        PositionFix first = inOrder ? one : other;
        PositionFix second = inOrder ? other : one;
        double distance = Geodesy.distance(first, second);
        return new Encounter(Phase.STARTED, first, second, distance, distance, t, t);
    }

    private static Encounter record(Phase phase, Encounter seen, double closest, long t) {
        return new Encounter(phase, seen.first(), seen.second(), seen.distance(), closest, seen.startTime(), t);
    }
}
