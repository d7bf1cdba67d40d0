package io.furrow.analytics.collision.encounter;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeSet;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.collision.CollisionOracle;
import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.DebounceRules;
import io.furrow.analytics.collision.rules.ExclusionZones;
import io.furrow.analytics.collision.rules.PositionRules;
import io.furrow.analytics.collision.rules.Thresholds;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** Stages that are restored with other rules than those by which their state was made: what is open ends, and all begins anew. */
@Tag("full")
class ChangedRulesTest {
    private static final Logger LOG = LoggerFactory.getLogger(ChangedRulesTest.class);
    private static final long BOUND = 1500;
    private static final long START = 1_700_000_000_000L;

    /** A start or an end, or that a pair continues across the change. */
    private record Event(Pair pair, Phase phase, long time) implements Comparable<Event> {
        static Event of(Encounter encounter) {
            return new Event(encounter.pair(), encounter.phase(), encounter.time());
        }

        @Override
        public int compareTo(Event other) {
            return toString().compareTo(other.toString());
        }
    }

    @Test
    void endsWhatIsOpenAndBeginsAnewWithTheNextReports() throws Exception {
        Run run = new Run(rules(10), new Random(1), rules(9));
        run.receive(east("r1", 0, START), east("r2", 8, START));
        run.advance(START);
        run.changeRules();
        run.receive(east("r1", 0, START + 1000), east("r2", 8, START + 1000));
        run.end();

        assertThat(run.told)
                .extracting(Encounter::phase, Encounter::startTime, Encounter::time)
                .containsExactly(
                        tuple(Phase.STARTED, START, START),
                        tuple(Phase.ENDED, START, START),
                        tuple(Phase.STARTED, START + 1000, START + 1000),
                        tuple(Phase.ENDED, START + 1000, START + 31_000));
    }

    @Test
    void goesOnWhereNoPairIsJudgedOtherwise() throws Exception {
        Run run = new Run(rules(10), new Random(1), rules(10).with(new DebounceRules(1, Duration.ofSeconds(3))));
        run.receive(east("r1", 0, START), east("r2", 8, START));
        run.advance(START);
        run.changeRules();
        run.end();

        assertThat(run.told).extracting(Encounter::phase).containsExactly(Phase.STARTED, Phase.ENDED);
        assertThat(run.told.get(1).time()).isEqualTo(START + 30_000);
    }

    @Test
    void isThatOfTheNewRulesOverAllThatComesLater() throws Exception {
        long seed = System.nanoTime();
        LOG.info("changed rules from seed {}", seed);
        int turned = 0;
        for (int i = 0; i < 60; i++) {
            Random random = new Random(seed + i);
            double threshold = Worlds.THRESHOLDS[i % 4];
            CollisionRules before = anyRules(threshold, 60_000, random);
            CollisionRules between = anyRules(threshold, 60_000, random);
            CollisionRules after = anyRules(threshold, 1 + random.nextInt(60_000), random);
            Worlds worlds = new Worlds(seed + i);
            List<PositionFix> fixes = worlds.wander(Worlds.centre(i), threshold, START);
            List<PositionFix> arrivals = worlds.shuffled(fixes, BOUND);
            int cut = random.nextInt(arrivals.size());

            Run run = random.nextBoolean()
                    ? new Run(before, random, after)
                    : new Run(before, random, random.nextBoolean() ? between : after, before, after);
            run.play(arrivals.subList(0, cut));
            long turn = run.reached;
            int told = run.told.size();
            run.changeRules();
            run.play(arrivals.subList(cut, arrivals.size()));
            run.end();

            Set<Event> expected = expected(fixes, before, after, turn);
            turned += expected.stream().anyMatch(event -> event.time() <= turn) ? 1 : 0;
            assertThat(events(run.told.subList(told, run.told.size())))
                    .as("case %d of seed %d, changed at %d", i, seed, turn - START)
                    .isEqualTo(expected);
        }
        assertThat(turned).as("changes that ended an encounter").isPositive();
    }

    /** By the definition, over what is later than the change; before that, the end of what was open. */
    private static Set<Event> expected(
            List<PositionFix> fixes, CollisionRules before, CollisionRules after, long turn) {
        Set<Event> expected = events(CollisionOracle.encounters(
                fixes.stream().filter(fix -> fix.time() > turn).toList(), after));
        closeAt(CollisionOracle.encounters(fixes, before), turn)
                .forEach(pair -> expected.add(new Event(pair, Phase.ENDED, newest(fixes, pair, turn))));
        return expected;
    }

    private static long newest(List<PositionFix> fixes, Pair pair, long until) {
        return fixes.stream()
                .filter(fix ->
                        fix.identity().equals(pair.first()) || fix.identity().equals(pair.second()))
                .mapToLong(PositionFix::time)
                .filter(time -> time <= until)
                .max()
                .orElseThrow();
    }

    private static Set<Pair> closeAt(List<Encounter> encounters, long time) {
        Set<Pair> close = new java.util.HashSet<>();
        encounters.stream()
                .filter(encounter -> encounter.phase() == Phase.ENDED)
                .filter(encounter -> encounter.startTime() <= time && encounter.time() > time)
                .forEach(encounter -> close.add(encounter.pair()));
        return close;
    }

    private static Set<Event> events(List<Encounter> told) {
        Set<Event> events = new TreeSet<>();
        told.stream()
                .filter(encounter -> encounter.phase() != Phase.ONGOING)
                .map(Event::of)
                .forEach(events::add);
        return events;
    }

    private static CollisionRules rules(double threshold) {
        return new CollisionRules(threshold, Duration.ofSeconds(30), Duration.ZERO, Duration.ofSeconds(1), 100);
    }

    /** Another threshold, also of a type, time-to-live, skew, and other cells. */
    private static CollisionRules anyRules(double threshold, int timeToLive, Random random) {
        double meters = Math.max(0.1, threshold * (0.3 + random.nextDouble()));
        Map<String, Double> ofTypes =
                random.nextBoolean() ? Map.of() : Map.of("ROBOT", Math.max(0.1, meters * random.nextDouble()));
        return new CollisionRules(
                new Thresholds(meters, ofTypes),
                new PositionRules(
                        Duration.ofMillis(timeToLive),
                        random.nextInt(3) == 0 ? Duration.ofMillis(random.nextInt(3000)) : Duration.ZERO,
                        ExclusionZones.NONE),
                DebounceRules.NONE,
                Duration.ofSeconds(1),
                new CellRules(threshold * (2 + 30 * random.nextDouble()), 0));
    }

    /** The three stages of the exact detection. */
    private static final class Run {
        private final List<CollisionRules> next;
        private final Random random;
        private final List<Encounter> told = new ArrayList<>();
        private Stage<Device, PositionFix, CellUpdate> track;
        private Stage<Long, CellUpdate, PairObservation> match;
        private Stage<Pair, PairObservation, Encounter> follow;
        private long newest = Long.MIN_VALUE;
        private long reached = Long.MIN_VALUE;

        /** @param next one after the other, all of them before event time continues */
        Run(CollisionRules before, Random random, CollisionRules... next) throws Exception {
            this.next = List.of(next);
            this.random = random;
            track = Stage.track(before);
            match = Stage.match(before);
            follow = Stage.follow(before);
        }

        void receive(PositionFix... fixes) throws Exception {
            for (PositionFix fix : fixes) {
                track.receive(fix);
                newest = Math.max(newest, fix.time());
            }
        }

        /** A watermark now and then, and a restart of a stage. */
        void play(List<PositionFix> arrivals) throws Exception {
            for (PositionFix fix : arrivals) {
                receive(fix);
                if (random.nextInt(10) == 0) {
                    List.of(track, match, follow).get(random.nextInt(3)).restart();
                }
                if (random.nextInt(4) == 0) {
                    advance(newest - BOUND - 1);
                }
            }
        }

        void advance(long watermark) throws Exception {
            reached = Math.max(reached, watermark);
            List<CellUpdate> updates = track.advance(watermark);
            Collections.shuffle(updates, random);
            match.receive(updates);
            List<PairObservation> observations = match.advance(watermark);
            Collections.shuffle(observations, random);
            follow.receive(observations);
            told.addAll(follow.advance(watermark));
        }

        void changeRules() throws Exception {
            for (CollisionRules rules : next) {
                changeTo(rules);
            }
        }

        private void changeTo(CollisionRules after) throws Exception {
            match.restartAs(Stage.match(after));
            follow.restartAs(Stage.follow(after));
            track.restartAs(Stage.track(after));
            told.addAll(follow.told());
            if (random.nextBoolean()) { // once more before anything is made of it
                match.restart();
                track.restart();
            }
        }

        void end() throws Exception {
            advance(Long.MAX_VALUE);
            for (Stage<?, ?, ?> stage : List.of(track, match, follow)) {
                assertThat(stage.stateEntries()).isZero();
                stage.stop();
            }
        }
    }
}
