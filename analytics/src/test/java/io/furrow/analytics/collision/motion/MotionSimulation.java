package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import io.furrow.analytics.collision.Simulation;
import io.furrow.analytics.position.PositionFix;

/** The stages without Flink: watermarks at random instants, and within each all keys in random order. */
final class MotionSimulation {
    private final MotionRules rules;
    private final Cubes cubes;
    private final SegmentBuilder navigator;
    private final Random random;
    private final Map<String, MotionState> motions = new HashMap<>();
    private final Map<Long, CubeIndex> indexes = new HashMap<>();
    private final Map<String, OngoingPrediction> foretold = new HashMap<>();
    private final Map<String, Contact> contacts = new HashMap<>();
    private final List<Approach> approaches = new ArrayList<>();

    private MotionSimulation(MotionRules rules, Random random) {
        this.rules = rules;
        this.random = random;
        cubes = new Cubes(rules);
        navigator = new SegmentBuilder(rules);
    }

    static List<Approach> approaches(Collection<PositionFix> fixes, MotionRules rules, Random random) {
        MotionSimulation simulation = new MotionSimulation(rules, random);
        List<PositionFix> waiting = new ArrayList<>(fixes);
        long watermark = fixes.stream().mapToLong(PositionFix::time).min().orElse(0);
        while (!waiting.isEmpty()) {
            watermark += random.nextInt(2000);
            simulation.advance(Simulation.taken(waiting, watermark), watermark);
        }
        simulation.advance(List.of(), Long.MAX_VALUE);
        simulation.contacts.values().forEach(open -> Contact.close(open, simulation.approaches::add));
        return simulation.approaches;
    }

    private void advance(List<PositionFix> due, long until) {
        List<SegmentUpdate> updates = new ArrayList<>();
        Simulation.grouped(due, PositionFix::key, random).forEach((device, fixes) -> {
            fixes.sort(PositionFix.SEQUENCE);
            motions.put(
                    device,
                    navigator.advance(motions.get(device), fixes, updates::add).known());
        });
        List<ApproachCandidate> predictions = new ArrayList<>();
        List<ApproachCandidate> found = new ArrayList<>();
        Simulation.grouped(updates, SegmentUpdate::cube, random).forEach((cube, all) -> {
            all.sort(SegmentUpdate.SEQUENCE);
            CubeIndex here = indexes.computeIfAbsent(cube, id -> CubeIndex.empty());
            here.apply(all, new ApproachDetector(rules, cubes, cube, predictions::add, found::add));
            here.forget(until, rules.timeToLive());
        });
        Simulation.grouped(predictions, ApproachCandidate::pair, random).forEach((pair, candidates) -> {
            candidates.sort(ApproachCandidate.SEQUENCE);
            foretold.put(pair, OngoingPrediction.follow(foretold.get(pair), candidates, rules, approaches::add));
        });
        Simulation.grouped(found, ApproachCandidate::pair, random).forEach((pair, candidates) -> {
            candidates.sort(ApproachCandidate.SEQUENCE);
            contacts.put(pair, Contact.join(contacts.get(pair), candidates, approaches::add));
        });
    }
}
