package io.furrow.analytics.collision.encounter;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.collision.CollisionOracle;
import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.TrackDevices;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class RestartedStagesTest {
    private static final Logger LOG = LoggerFactory.getLogger(RestartedStagesTest.class);
    private static final long BOUND = 1500;

    @Tag("full")
    @Test
    void tellTheSameAsTheDefinitionHoweverOftenTheyRestart() throws Exception {
        long seed = System.nanoTime();
        LOG.info("restarted stages from seed {}", seed);
        Random random = new Random(seed);
        int compared = 0;
        for (int i = 0; i < 40; i++) {
            double threshold = Worlds.THRESHOLDS[i % 4];
            CollisionRules rules =
                    i < 8 ? Worlds.rules(threshold, 3, i % 3 == 0) : Worlds.anyRules(threshold, seed + i);
            Worlds worlds = new Worlds(seed + i);
            List<PositionFix> fixes = worlds.wander(Worlds.centre(i), threshold, 1_700_000_000_000L);
            List<Encounter> expected = CollisionOracle.encounters(fixes, rules);
            List<Encounter> found = encounters(worlds.shuffled(fixes, BOUND), rules, random);
            assertThat(CollisionOracle.difference(found, expected))
                    .as("case %d of seed %d", i, seed)
                    .isEmpty();
            compared += expected.size();
        }
        assertThat(compared).isGreaterThan(20);
    }

    private static List<Encounter> encounters(List<PositionFix> arrivals, CollisionRules rules, Random random)
            throws Exception {
        List<Encounter> encounters = new ArrayList<>();
        var track = Stage.track(rules);
        var match = Stage.match(rules);
        var follow = Stage.follow(rules);
        var steady = Stage.steady(rules);
        List<Stage<?, ?, ?>> stages = List.of(track, match, follow, steady);
        long newest = Long.MIN_VALUE;
        for (PositionFix fix : arrivals) {
            track.receive(fix);
            newest = Math.max(newest, fix.time());
            if (random.nextInt(10) == 0) {
                stages.get(random.nextInt(4)).restart();
            }
            if (random.nextInt(4) == 0) {
                List<Encounter> exact = advance(newest - BOUND - 1, random, track, match, follow);
                encounters.addAll(steadied(exact, newest - BOUND - 1, rules, steady));
            }
        }
        List<Encounter> exact = advance(Long.MAX_VALUE, random, track, match, follow);
        encounters.addAll(steadied(exact, Long.MAX_VALUE, rules, steady));
        assertThat(track.side(TrackDevices.LATE)).isEmpty();
        for (Stage<?, ?, ?> stage : stages) {
            stage.stopEmpty();
        }

        encounters.sort(CollisionOracle.ORDER);
        return encounters;
    }

    private static List<Encounter> steadied(
            List<Encounter> exact, long watermark, CollisionRules rules, Stage<Pair, Encounter, Encounter> steady)
            throws Exception {
        if (rules.steadiness().isNone()) {
            return exact;
        }
        steady.receive(exact);
        return steady.advance(watermark);
    }

    private static List<Encounter> advance(
            long watermark,
            Random random,
            Stage<Device, PositionFix, CellUpdate> track,
            Stage<Long, CellUpdate, PairObservation> match,
            Stage<Pair, PairObservation, Encounter> follow)
            throws Exception {
        List<CellUpdate> updates = track.advance(watermark);
        Collections.shuffle(updates, random);
        match.receive(updates);
        List<PairObservation> observations = match.advance(watermark);
        Collections.shuffle(observations, random);
        follow.receive(observations);
        return follow.advance(watermark);
    }
}
