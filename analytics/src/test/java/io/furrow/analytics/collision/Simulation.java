package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.function.Function;

import io.furrow.analytics.collision.debounce.EncounterDebouncer;
import io.furrow.analytics.collision.debounce.SteadyState;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.EncounterTracker;
import io.furrow.analytics.collision.encounter.OpenEncounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Grid;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.collision.grid.Tracker;
import io.furrow.analytics.collision.matching.Cell;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.matching.PairSelection;
import io.furrow.analytics.collision.matching.ReportCrowds;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/** All stages without Flink: watermarks at random instants, and within each all keys in random order. */
public final class Simulation {
    private final Tracker tracker;
    private final PairSelection pairSelection;
    private final ReportCrowds reports;
    private final EncounterTracker encounterTracker;
    private final EncounterDebouncer steadier;
    private final Random random;
    private final Map<String, Track> tracks = new HashMap<>();
    private final Map<Long, Cell> cells = new HashMap<>();
    private final Map<Pair, OpenEncounter> openEncounters = new HashMap<>();
    private final Map<Pair, SteadyState> courses = new HashMap<>();
    private final List<Encounter> encounters = new ArrayList<>();
    private final List<CollisionOracle.Overflow> overflows = new ArrayList<>();
    private int violations;

    private Simulation(CollisionRules rules, Random random) {
        tracker = new Tracker(rules.exact());
        pairSelection = new PairSelection(rules.exact());
        reports = new ReportCrowds(pairSelection, new Grid(rules.exact()));
        encounterTracker = new EncounterTracker(rules.exact());
        steadier = rules.steadiness().isNone() ? null : new EncounterDebouncer(rules);
        this.random = random;
    }

    public static List<Encounter> encounters(List<PositionFix> fixes, CollisionRules rules, Random random) {
        return result(fixes, rules, random).encounters();
    }

    static CollisionOracle.Result result(List<PositionFix> fixes, CollisionRules rules, Random random) {
        Simulation simulation = new Simulation(rules, random);
        List<PositionFix> waiting = new ArrayList<>(fixes);
        long watermark = fixes.stream().mapToLong(PositionFix::time).min().orElse(0);
        while (!waiting.isEmpty()) {
            watermark += random.nextInt(2000);
            simulation.advance(taken(waiting, watermark), watermark);
        }
        simulation.advance(List.of(), Long.MAX_VALUE);
        if (simulation.violations != 0) {
            throw new AssertionError(simulation.violations + " violations");
        }
        if (!simulation.cells.values().stream().allMatch(Cell::isEmpty) || !simulation.courses.isEmpty()) {
            throw new AssertionError("something is remembered of devices or pairs that are gone");
        }
        simulation.encounters.sort(CollisionOracle.ORDER);
        simulation.overflows.sort(CollisionOracle.Overflow.ORDER);
        return new CollisionOracle.Result(simulation.encounters, simulation.overflows);
    }

    private void advance(List<PositionFix> due, long until) {
        List<CellUpdate> updates = new ArrayList<>();
        Map<String, List<PositionFix>> fixes = grouped(due, PositionFix::identity, random);
        tracks.keySet().forEach(identity -> fixes.putIfAbsent(identity, List.of()));
        fixes.forEach((identity, of) -> {
            List<PositionFix> sorted = new ArrayList<>(of);
            sorted.sort(PositionFix.SEQUENCE);
            Track before = tracks.get(identity);
            tracks.put(identity, tracker.advance(before, sorted, until, updates::add));
        });
        List<PairObservation> observations = new ArrayList<>();
        grouped(updates, CellUpdate::cell, random).forEach((cell, of) -> match(cell, of, observations));
        cells.forEach((id, cell) -> reports.advance(id, cell, until, this::tell));
        grouped(observations, PairObservation::pair, random).forEach((pair, of) -> follow(pair, of, until));
        for (Pair pair : List.copyOf(courses.keySet())) {
            courses.put(pair, steadier.advance(courses.get(pair), until, encounters::add));
        }
    }

    private void match(long id, List<CellUpdate> updates, List<PairObservation> out) {
        updates.sort(CellUpdate.SEQUENCE);
        Cell cell = cells.computeIfAbsent(id, any -> Cell.empty());
        int from = 0;
        while (from < updates.size()) {
            int to = Cell.endOfInstant(updates, from);
            long time = updates.get(from).time();
            reports.advance(id, cell, time - 1, this::tell);
            cell.apply(updates.subList(from, to), pairSelection, out::add);
            reports.applied(id, cell, time, this::tell);
            from = to;
        }
    }

    private void tell(CellOverflow overflow) {
        overflows.add(CollisionOracle.Overflow.of(overflow));
    }

    private void follow(Pair pair, List<PairObservation> observations, long until) {
        observations.sort(PairObservation.SEQUENCE);
        List<Encounter> exact = steadier == null ? encounters : new ArrayList<>();
        OpenEncounter before = openEncounters.get(pair);
        EncounterTracker.Followed followed = encounterTracker.follow(before, observations, exact::add);
        violations += followed.violations();
        openEncounters.put(pair, followed.encounter());
        for (Encounter encounter : steadier == null ? List.<Encounter>of() : exact) {
            courses.compute(pair, (key, course) -> steadier.next(course, encounter, encounters::add));
        }
    }

    /** The elements of each key in random order. */
    public static <K, T> Map<K, List<T>> grouped(List<T> all, Function<T, K> key, Random random) {
        List<T> shuffled = new ArrayList<>(all);
        java.util.Collections.shuffle(shuffled, random);
        Map<K, List<T>> groups = new HashMap<>();
        shuffled.forEach(each ->
                groups.computeIfAbsent(key.apply(each), k -> new ArrayList<>()).add(each));
        return groups;
    }

    /** Removes what is due. */
    public static List<PositionFix> taken(List<PositionFix> waiting, long watermark) {
        List<PositionFix> due =
                waiting.stream().filter(fix -> fix.time() <= watermark).toList();
        waiting.removeIf(fix -> fix.time() <= watermark);
        return due;
    }
}
