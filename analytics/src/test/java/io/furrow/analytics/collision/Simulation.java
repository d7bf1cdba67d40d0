package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Random;
import java.util.function.Function;

/** The three stages without Flink: watermarks at random instants, and within each all keys in random order. */
final class Simulation {
    private final Tracker tracker;
    private final Proximity proximity;
    private final Follower follower;
    private final Random random;
    private final Map<String, Track> tracks = new HashMap<>();
    private final Map<Long, Cell> cells = new HashMap<>();
    private final Map<String, Optional<Meeting>> meetings = new HashMap<>();
    private final List<Encounter> encounters = new ArrayList<>();
    private int violations;

    private Simulation(CollisionRules rules, Random random) {
        tracker = new Tracker(rules);
        proximity = new Proximity(rules);
        follower = new Follower(rules);
        this.random = random;
    }

    static List<Encounter> encounters(List<PositionFix> fixes, CollisionRules rules, Random random) {
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
        simulation.encounters.sort(CollisionOracle.ORDER);
        return simulation.encounters;
    }

    private void advance(List<PositionFix> due, long until) {
        List<CellUpdate> updates = new ArrayList<>();
        Map<String, List<PositionFix>> fixes = grouped(due, PositionFix::identity);
        tracks.keySet().forEach(identity -> fixes.putIfAbsent(identity, List.of()));
        fixes.forEach((identity, of) -> {
            List<PositionFix> sorted = new ArrayList<>(of);
            sorted.sort(PositionFix.SEQUENCE);
            Track before = tracks.getOrDefault(identity, Track.NOWHERE);
            tracks.put(identity, tracker.advance(before, sorted, until, updates::add));
        });
        List<Sighting> sightings = new ArrayList<>();
        grouped(updates, CellUpdate::cell).forEach((cell, of) -> {
            of.sort(CellUpdate.SEQUENCE);
            cells.computeIfAbsent(cell, id -> Cell.empty()).apply(of, proximity, sightings::add);
        });
        grouped(sightings, Sighting::pair).forEach((pair, of) -> {
            of.sort(Sighting.SEQUENCE);
            Optional<Meeting> before = meetings.getOrDefault(pair, Optional.empty());
            Follower.Followed followed = follower.follow(before, of, encounters::add);
            violations += followed.violations();
            meetings.put(pair, followed.meeting());
        });
    }

    private <K, T> Map<K, List<T>> grouped(List<T> all, Function<T, K> key) {
        List<T> shuffled = new ArrayList<>(all);
        java.util.Collections.shuffle(shuffled, random);
        Map<K, List<T>> groups = new HashMap<>();
        shuffled.forEach(each ->
                groups.computeIfAbsent(key.apply(each), k -> new ArrayList<>()).add(each));
        return groups;
    }

    private static List<PositionFix> taken(List<PositionFix> waiting, long watermark) {
        List<PositionFix> due =
                waiting.stream().filter(fix -> fix.time() <= watermark).toList();
        waiting.removeIf(fix -> fix.time() <= watermark);
        return due;
    }
}
