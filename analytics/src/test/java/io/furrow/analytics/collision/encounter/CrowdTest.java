package io.furrow.analytics.collision.encounter;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.collision.CollisionOracle;
import io.furrow.analytics.collision.Fixes;
import io.furrow.analytics.collision.Simulation;
import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.grid.CellPresence;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.matching.Cell;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.matching.MatchPairs;
import io.furrow.analytics.collision.matching.PairSelection;
import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** Many devices on one spot, and few others. */
class CrowdTest {
    private static final Logger LOG = LoggerFactory.getLogger(CrowdTest.class);
    private static final long START = 1_700_000_000_000L;
    private static final int CROWD = 10;
    private static final double[] PLACE = {40.3125, -3.4821};

    private final Random random = seeded();

    private static Random seeded() {
        long seed = System.nanoTime();
        LOG.info("crowds from seed {}", seed);
        return Seeds.random(seed);
    }

    @Test
    void keepsTheObservationsOfASpotTheSameHoweverManyDevicesAreThere() {
        int pairs = 40 * 40;
        for (int devices : new int[] {200, 400, 800, 1600}) {
            assertThat(observations(devices)).as("of %d devices", devices).isBetween(pairs / 2, 4 * pairs);
        }
    }

    /** A border cuts the spot: of its other side the cell has halo copies, which never meet each other here. */
    @Test
    void findsACrowdThatStandsOnBothSidesOfABorder() {
        Cell cell = Cell.empty();
        PairSelection pairSelection = new PairSelection(rules(CROWD, 100));
        List<PairObservation> seen = new ArrayList<>();
        for (int second = 0; second < 3; second++) {
            seen.clear();
            for (PositionFix fix : second(200, second, 0.3)) {
                CellPresence cellPresence =
                        fix.id().length() < 3 ? CellPresence.RESIDENT : CellPresence.HALO; // ten of them
                cell.apply(List.of(new CellUpdate(7, fix.time(), cellPresence, fix)), pairSelection, seen::add);
            }
        }
        assertThat(seen).as("of 10 x 190 pairs").hasSizeBetween(200, 800);
    }

    /** In the third second, in which all have shortlists. */
    private int observations(int devices) {
        Cell cell = Cell.empty();
        PairSelection pairSelection = new PairSelection(rules(40, 100));
        List<PairObservation> seen = new ArrayList<>();
        for (int second = 0; second < 3; second++) {
            seen.clear();
            for (PositionFix fix : second(devices, second, 0.3)) {
                CellUpdate update = new CellUpdate(7, fix.time(), CellPresence.RESIDENT, fix);
                cell.apply(List.of(update), pairSelection, seen::add);
            }
        }
        return seen.size();
    }

    @Test
    void followsAllOfADeviceThatIsInNoCrowdAndTheNearestOfAnyOtherOnEveryGrid() {
        int crowded = 0;
        for (double cell : new double[] {5, 17, 100, 1e9}) {
            List<PositionFix> fixes = seconds(60, 6, 4);
            Map<String, Set<String>> open = new HashMap<>();
            Map<String, PositionFix> last = new HashMap<>();
            List<Encounter> encounters = Simulation.encounters(fixes, rules(CROWD, cell), random);
            int next = 0;
            for (List<PositionFix> instant : instants(fixes)) {
                instant.forEach(fix -> last.put(fix.identity(), fix));
                long time = instant.get(0).time();
                for (; next < encounters.size() && encounters.get(next).time() <= time; next++) {
                    follow(encounters.get(next), open);
                }
                for (PositionFix fix : instant) {
                    List<PositionFix> close = last.values().stream()
                            .filter(other -> other != fix && Geodesy.distance(fix, other) <= 5)
                            .toList();
                    crowded += close.size() > CROWD ? 1 : 0;
                    assertThat(open.getOrDefault(fix.identity(), Set.of()))
                            .as("of %s with %d close, cells of %s m", fix, close.size(), cell)
                            .containsAll(certain(fix, close).stream()
                                    .map(PositionFix::identity)
                                    .toList());
                }
            }
        }
        assertThat(crowded).isGreaterThan(100);
    }

    private static List<List<PositionFix>> instants(List<PositionFix> fixes) {
        List<List<PositionFix>> instants = new ArrayList<>();
        long time = Long.MIN_VALUE;
        for (PositionFix fix : fixes) {
            if (fix.time() != time) {
                instants.add(new ArrayList<>());
                time = fix.time();
            }
            instants.get(instants.size() - 1).add(fix);
        }
        return instants;
    }

    /** All, or those of the nearest quarters of the threshold that have room together. */
    private static List<PositionFix> certain(PositionFix fix, List<PositionFix> close) {
        if (close.size() <= CROWD) {
            return close;
        }
        int room = Math.max(1, CROWD * CROWD / close.size());
        List<PositionFix> certain = List.of();
        for (int quarter = 1; quarter <= 4; quarter++) {
            double reach = quarter * 5 / 4.0;
            List<PositionFix> within = close.stream()
                    .filter(other -> Geodesy.distance(fix, other) <= reach)
                    .toList();
            certain = within.size() <= room ? within : certain;
        }
        return certain;
    }

    @Test
    void endsEveryEncounterThatItStarts() {
        List<PositionFix> fixes = seconds(80, 5, 3);
        List<Encounter> encounters = Simulation.encounters(fixes, rules(CROWD, 100), random);
        assertThat(CollisionOracle.difference(encounters, CollisionOracle.encounters(fixes, rules(CROWD, 100))))
                .isEmpty();
        Map<String, Set<String>> open = new HashMap<>();
        encounters.forEach(encounter -> follow(encounter, open));
        assertThat(encounters).hasSizeGreaterThan(200);
        assertThat(open.values()).allMatch(Set::isEmpty);
    }

    @Test
    void seesTheSameAsWithoutALimitWhereNobodyIsInACrowd() {
        List<PositionFix> fixes = seconds(60, 6, 8);
        assertThat(Simulation.encounters(fixes, rules(59, 100), random))
                .isNotEmpty()
                .isEqualTo(Simulation.encounters(fixes, rules(0, 20), random));
    }

    @Test
    void tellsOfACrowdAtOnceThenOnceAMinuteAndOnceMoreWhenItIsOver() throws Exception {
        var stage = Stage.match(rules(3, 100));
        List<CellOverflow> told = new ArrayList<>();
        for (int second = 0; second < 130; second++) {
            stage.receive(updates(second, CellPresence.RESIDENT));
            stage.advance(START + second * 1000 + 999);
            if (second % 7 == 0) {
                told.addAll(stage.side(MatchPairs.OVERFLOWS));
                stage.restart();
            }
        }
        stage.receive(updates(130, CellPresence.GONE));
        stage.advance(START + 240_799);
        assertThat(stage.stateEntries()).isEqualTo(1);
        stage.advance(START + 240_800);
        assertThat(stage.stateEntries()).isZero();
        told.addAll(stage.side(MatchPairs.OVERFLOWS));
        stage.stop();

        assertThat(told)
                .extracting(CellOverflow::time, CellOverflow::devices, CellOverflow::pairs)
                .containsExactly(
                        tuple(START + 800, 5, 10L),
                        tuple(START + 60_800, 5, 10L),
                        tuple(START + 120_800, 5, 10L),
                        tuple(START + 180_800, 0, 0L));
    }

    private List<CellUpdate> updates(int second, CellPresence cellPresence) {
        return second(5, second, 0.3).stream()
                .map(fix -> new CellUpdate(7, fix.time(), cellPresence, fix))
                .toList();
    }

    private static void follow(Encounter encounter, Map<String, Set<String>> open) {
        String first = encounter.first().identity();
        String second = encounter.second().identity();
        for (String[] pair : new String[][] {{first, second}, {second, first}}) {
            Set<String> partners = open.computeIfAbsent(pair[0], none -> new HashSet<>());
            if (encounter.phase() == Phase.ENDED) {
                partners.remove(pair[1]);
            } else {
                partners.add(pair[1]);
            }
        }
    }

    private static CollisionRules rules(int crowd, double cell) {
        return CollisionRules.DEFAULT.with(new CellRules(cell, crowd));
    }

    private List<PositionFix> seconds(int devices, int seconds, double spread) {
        List<PositionFix> fixes = new ArrayList<>();
        for (int second = 0; second < seconds; second++) {
            fixes.addAll(second(devices, second, spread));
        }
        return fixes;
    }

    /** A report of each, some of them at one instant; about the place with so many meters of standard deviation. */
    private List<PositionFix> second(int devices, int second, double spread) {
        List<PositionFix> fixes = new ArrayList<>();
        for (int device = 0; device < devices; device++) {
            double[] place = Worlds.place(PLACE, spread * random.nextGaussian(), spread * random.nextGaussian());
            long time = START + second * 1000L + device * 1000L / devices / 2 * 2;
            fixes.add(Fixes.at("d" + device, place[0], place[1], time));
        }
        return fixes;
    }
}
