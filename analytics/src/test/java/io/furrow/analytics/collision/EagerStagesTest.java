package io.furrow.analytics.collision;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.co.KeyedCoProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.debounce.DebounceRules;
import io.furrow.analytics.collision.eager.Arrival;
import io.furrow.analytics.collision.eager.ProvisionalProximity;
import io.furrow.analytics.collision.eager.RaiseAlarms;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.encounter.Stage;
import io.furrow.analytics.collision.grid.Presence;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.position.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;

/** Each stage of eager mode alone, stopped with a snapshot in the middle. */
class EagerStagesTest {
    private static final CollisionRules RULES =
            new CollisionRules(5, Duration.ofSeconds(3), Duration.ZERO, Duration.ZERO, 100);

    @Test
    void tracksWhatArrivesAtOnceAndPassesOverWhatIsOlder() throws Exception {
        var stage = Stage.arrivals(RULES);
        stage.receive(east("a", 50, 1000));
        assertThat(stage.told()).isNotEmpty().allMatch(arrival -> arrival.version() == 1000);
        stage.restart();
        stage.receive(List.of(east("a", 60, 900), east("a", 50, 1000)));
        assertThat(stage.told()).isEmpty();
        stage.receive(east("a", 51, 1000));
        assertThat(stage.told()).isNotEmpty().allMatch(arrival -> arrival.version() == 1001);
        stage.receive(east("a", 2050, 1001));
        assertThat(stage.told())
                .allMatch(arrival -> arrival.version() == 1002)
                .extracting(Arrival::presence)
                .contains(Presence.GONE, Presence.RESIDENT);
        assertThat(stage.timers()).isEqualTo(1);
        stage.advance(4000);
        assertThat(stage.stateEntries()).isEqualTo(1);
        stage.advance(4001);
        assertLeavesNothing(stage);
    }

    @Test
    void spotsAPairAtOnceAndThatItIsOneNoMore() throws Exception {
        var stage = Stage.spot(RULES);
        stage.receive(resident("a", 0, 1000, 1000));
        stage.receive(resident("b", 3, 1100, 1100));
        assertThat(stage.told())
                .containsExactly(new ProvisionalProximity(east("a", 0, 1000), east("b", 3, 1100), 1000, 1100, true));
        stage.restart();
        stage.receive(resident("b", 9, 1050, 1050));
        assertThat(stage.told()).as("older than what is known").isEmpty();
        stage.receive(resident("b", 9, 1200, 1200));
        assertThat(stage.told())
                .extracting(ProvisionalProximity::close, ProvisionalProximity::secondVersion)
                .containsExactly(org.assertj.core.groups.Tuple.tuple(false, 1200L));
        assertThat(stage.timers()).isEqualTo(1);
        stage.advance(4199);
        assertThat(stage.stateEntries()).isNotZero();
        stage.advance(9000);
        assertLeavesNothing(stage);
    }

    @Test
    void letsGoOfWhomItHearsNoMore() throws Exception {
        var stage = Stage.spot(RULES);
        stage.receive(resident("a", 0, 1000, 1000));
        stage.receive(resident("b", 3, 1500, 1500));
        stage.told();
        stage.restart();
        assertThat(stage.advance(3999)).isEmpty();
        assertThat(stage.advance(4000)).extracting(ProvisionalProximity::close).containsExactly(false);
        stage.advance(9000);
        assertLeavesNothing(stage);
    }

    @Test
    void remembersWhoHasLeftUntilTheWatermarkHasPassedIt() throws Exception {
        var stage = Stage.spot(RULES);
        PositionFix here = east("a", 0, 1000);
        stage.receive(new Arrival(7, 1200, Presence.GONE, here));
        stage.restart();
        stage.receive(new Arrival(7, 1000, Presence.RESIDENT, here));
        stage.receive(resident("b", 3, 1100, 1100));
        assertThat(stage.told())
                .as("what left with version 1200 is not brought back by 1000")
                .isEmpty();
        stage.advance(9000);
        assertLeavesNothing(stage);
    }

    @Test
    void confirmsWithTheStartWhatWasToldAndWithdrawsTheRest() throws Exception {
        Alarms alarms = new Alarms(RULES);
        Encounter provisional = alarms.glimpse(0, 2, 1000, true).get(0);
        assertThat(provisional.phase()).isEqualTo(Phase.PROVISIONAL);
        assertThat(alarms.glimpse(0, 3, 1100, true)).as("told once").isEmpty();
        assertThat(alarms.glimpse(0, 30, 1200, false)).isEmpty();
        Encounter again = alarms.glimpse(0, 4, 1300, true).get(0);
        alarms.restart();
        Encounter start = alarms.exact(Phase.STARTED, 1000, 1000);
        Encounter end = alarms.exact(Phase.ENDED, 1000, 1200);

        assertThat(alarms.advance(999)).isEmpty();
        assertThat(alarms.advance(1000)).containsExactly(start.confirming(provisional));
        assertThat(alarms.advance(1299)).containsExactly(end);
        alarms.restart();
        assertThat(alarms.advance(1300)).containsExactly(again.withdrawn());

        assertThat(alarms.glimpse(0, 30, 1400, false)).isEmpty();
        alarms.advance(1399);
        assertThat(alarms.stateEntries()).isNotZero();
        alarms.advance(1400);
        assertThat(alarms.stateEntries()).isZero();
        assertThat(alarms.timers()).isZero();
        alarms.stop();
    }

    @Test
    void confirmsAlsoWhereTheExactStartComesBeforeTheGlimpse() throws Exception {
        Alarms alarms = new Alarms(RULES);
        Encounter start = alarms.exact(Phase.STARTED, 1000, 1000);
        Encounter provisional = alarms.glimpse(0, 2, 1000, true).get(0);
        assertThat(alarms.advance(1000)).containsExactly(start.confirming(provisional));
        alarms.glimpse(0, 30, 1100, false);
        alarms.advance(1100);
        assertThat(alarms.stateEntries()).isZero();
        alarms.stop();
    }

    /** The start is reported at the end of the dwell, and is the start of what was reported at its beginning. */
    @Test
    void waitsForTheDwellBeforeItWithdraws() throws Exception {
        Alarms alarms = new Alarms(RULES.with(new DebounceRules(1, Duration.ofMillis(500))));
        Encounter provisional = alarms.glimpse(0, 2, 1000, true).get(0);
        assertThat(alarms.advance(1500)).isEmpty();
        Encounter start = alarms.exact(Phase.STARTED, 1000, 1500);
        assertThat(alarms.advance(1501)).containsExactly(start.confirming(provisional));
        alarms.glimpse(0, 30, 2000, false);
        Encounter second = alarms.glimpse(0, 2, 2100, true).get(0);
        assertThat(alarms.advance(2600)).isEmpty();
        assertThat(alarms.advance(2601)).containsExactly(second.withdrawn());
        alarms.stop();
    }

    /** Of a pair that is close a glimpse comes with each report; rules that were changed on a savepoint report it no more. */
    @Test
    void forgetsAPairThatNobodySeesForATimeToLive() throws Exception {
        long timeToLive = RULES.timeToLive().toMillis();
        Alarms alarms = new Alarms(RULES);
        Encounter provisional = alarms.glimpse(0, 2, 1000, true).get(0);
        assertThat(alarms.advance(1000)).containsExactly(provisional.withdrawn());

        alarms.glimpse(0, 2, 1500, true);
        alarms.advance(1500 + timeToLive - 1);
        assertThat(alarms.stateEntries()).isNotZero();
        alarms.advance(1500 + timeToLive);

        assertThat(alarms.stateEntries()).isZero();
        assertThat(alarms.timers()).isZero();
        alarms.stop();
    }

    private Arrival resident(String device, double meters, long time, long version) {
        return new Arrival(7, version, Presence.RESIDENT, east(device, meters, time));
    }

    private static void assertLeavesNothing(Stage<?, ?, ?> stage) throws Exception {
        assertThat(stage.stateEntries()).isZero();
        assertThat(stage.timers()).isZero();
        stage.stop();
    }

    /** The last stage, of one pair. */
    private static final class Alarms {
        private final CollisionRules rules;
        private KeyedTwoInputStreamOperatorTestHarness<Pair, Encounter, ProvisionalProximity, Encounter> harness;

        Alarms(CollisionRules rules) throws Exception {
            this.rules = rules;
            start();
            harness.open();
        }

        List<Encounter> glimpse(double first, double second, long time, boolean close) throws Exception {
            PositionFix a = east("a", first, time);
            PositionFix b = east("b", second, time);
            harness.processElement2(new ProvisionalProximity(a, b, time, time, close), time);
            return told();
        }

        Encounter exact(Phase phase, long start, long time) throws Exception {
            Encounter exact = new Encounter(phase, east("a", 0, start), east("b", 2, start), 2, 2, start, time);
            harness.processElement1(exact, time);
            assertThat(told()).as("waits for the watermark of both").isEmpty();
            return exact;
        }

        List<Encounter> advance(long watermark) throws Exception {
            harness.processWatermark1(new Watermark(watermark));
            assertThat(told()).as("waits for the watermark of both").isEmpty();
            harness.processWatermark2(new Watermark(watermark));
            return told();
        }

        void restart() throws Exception {
            OperatorSubtaskState snapshot = harness.snapshot(1, 1);
            harness.close();
            start();
            harness.initializeState(snapshot);
            harness.open();
        }

        int stateEntries() {
            return harness.numKeyedStateEntries();
        }

        int timers() {
            return harness.numEventTimeTimers();
        }

        void stop() throws Exception {
            harness.close();
        }

        private void start() throws Exception {
            harness = new KeyedTwoInputStreamOperatorTestHarness<>(
                    new KeyedCoProcessOperator<>(new RaiseAlarms(rules)),
                    Encounter::pair,
                    ProvisionalProximity::pair,
                    TypeInformation.of(Pair.class));
        }

        private List<Encounter> told() {
            List<Encounter> told = new ArrayList<>(harness.extractOutputValues());
            harness.getOutput().clear();
            return told;
        }
    }
}
