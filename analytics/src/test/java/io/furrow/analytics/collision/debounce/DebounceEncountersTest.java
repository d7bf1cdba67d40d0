package io.furrow.analytics.collision.debounce;

import java.time.Duration;
import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.encounter.Stage;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.DebounceRules;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;
import static org.assertj.core.groups.Tuple.tuple;

/** Threshold 5 m; encounters last up to 10 m where the factor is 2. */
class DebounceEncountersTest {
    private static final Duration NO_DWELL = Duration.ZERO;
    private static final Duration SECOND = Duration.ofSeconds(1);

    private Stage<Pair, Encounter, Encounter> stage;

    @AfterEach
    void leaveNothing() throws Exception {
        stage.receive(seen(Phase.ENDED, 1, 90_000));
        stage.advance(Long.MAX_VALUE);
        stage.stopEmpty();
    }

    @Test
    void startAtTheThresholdAndLastUpToTheGreaterDistance() throws Exception {
        start(2, NO_DWELL);
        stage.receive(List.of(
                seen(Phase.STARTED, 9, 1000),
                seen(Phase.ONGOING, 6, 2000),
                seen(Phase.ONGOING, 4, 3000),
                seen(Phase.ONGOING, 8, 4000),
                seen(Phase.ENDED, 8, 5000)));
        List<Encounter> told = stage.advance(5000);
        assertThat(told)
                .extracting(Encounter::phase, Encounter::time, Encounter::startTime)
                .containsExactly(
                        tuple(Phase.STARTED, 3000L, 3000L),
                        tuple(Phase.ONGOING, 4000L, 3000L),
                        tuple(Phase.ENDED, 5000L, 3000L));
        assertThat(told.get(2).minDistance()).isCloseTo(4, within(1e-6));
    }

    @Test
    void tellNothingOfDevicesThatOnlyPassOutsideTheThreshold() throws Exception {
        start(2, NO_DWELL);
        stage.receive(
                List.of(seen(Phase.STARTED, 9, 1000), seen(Phase.ONGOING, 5.01, 2000), seen(Phase.ENDED, 5.01, 3000)));
        assertThat(stage.advance(3000)).isEmpty();
    }

    @Test
    void areToldWhenTheyHaveLastedForTheDwellAlsoIfNothingIsSeenThen() throws Exception {
        start(1, SECOND);
        stage.receive(List.of(seen(Phase.STARTED, 4, 1000), seen(Phase.ONGOING, 3, 1500)));
        assertThat(stage.advance(1999)).isEmpty();
        List<Encounter> told = stage.advance(2000);
        assertThat(told)
                .extracting(Encounter::phase, Encounter::time, Encounter::startTime)
                .containsExactly(tuple(Phase.STARTED, 2000L, 1000L));
        assertThat(told.get(0).distance()).isCloseTo(3, within(1e-6));
        stage.receive(seen(Phase.ENDED, 3, 2500));
        assertThat(stage.advance(2500)).extracting(Encounter::phase).containsExactly(Phase.ENDED);
    }

    @Test
    void areToldAtTheSameInstantHoweverFarTheWatermarkJumps() throws Exception {
        start(1, SECOND);
        stage.receive(List.of(seen(Phase.STARTED, 4, 1000), seen(Phase.ENDED, 4, 2001)));
        assertThat(stage.advance(9000))
                .extracting(Encounter::phase, Encounter::time)
                .containsExactly(tuple(Phase.STARTED, 2000L), tuple(Phase.ENDED, 2001L));
    }

    @Test
    void areNotToldWhenTheyEndAtTheInstantOfTheDwellOrSooner() throws Exception {
        start(1, SECOND);
        stage.receive(List.of(seen(Phase.STARTED, 4, 1000), seen(Phase.ENDED, 4, 2000)));
        assertThat(stage.advance(3000)).isEmpty();
        stage.receive(List.of(seen(Phase.STARTED, 4, 4000), seen(Phase.ENDED, 4, 4900)));
        assertThat(stage.advance(6000)).isEmpty();
    }

    @Test
    void goOnAfterARestart() throws Exception {
        start(2, SECOND);
        stage.receive(List.of(seen(Phase.STARTED, 4, 1000), seen(Phase.ONGOING, 8, 1500)));
        assertThat(stage.advance(1500)).isEmpty();
        stage.restart();
        assertThat(stage.advance(2000))
                .extracting(Encounter::phase, Encounter::time)
                .containsExactly(tuple(Phase.STARTED, 2000L));
    }

    private void start(double factor, Duration dwell) throws Exception {
        stage = Stage.steady(CollisionRules.DEFAULT.with(new DebounceRules(factor, dwell)));
    }

    /** What the exact stages report b at the place and a so many meters east of it. */
    private static Encounter seen(Phase phase, double meters, long time) {
        return new Encounter(phase, east("a", meters, time), east("b", 0, time), meters, 0, 0, time);
    }
}
