package io.furrow.analytics.collision.encounter;

import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.rules.CollisionRules;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class TrackEncountersTest {
    private Stage<Pair, PairObservation, Encounter> stage;

    @BeforeEach
    void start() throws Exception {
        stage = Stage.follow(CollisionRules.DEFAULT);
    }

    @AfterEach
    void leaveNothing() throws Exception {
        stage.receive(seen(0, 90_000, -1));
        stage.advance(90_000);
        stage.stopEmpty();
    }

    @Test
    void tellsAnEncounterFromStartToEndWithItsClosestDistance() throws Exception {
        stage.receive(List.of(seen(4, 1000, 1), seen(1, 2000, 0), seen(3, 3000, 0), seen(3, 4000, -1)));
        List<Encounter> encounters = stage.advance(4000);
        assertThat(encounters)
                .extracting(Encounter::phase)
                .containsExactly(Phase.STARTED, Phase.ONGOING, Phase.ONGOING, Phase.ENDED);
        Encounter end = encounters.get(3);
        assertThat(end.first()).isEqualTo(east("a", 3, 4000));
        assertThat(end.second()).isEqualTo(east("b", 0, 4000));
        assertThat(end.distance()).isCloseTo(3, within(1e-6));
        assertThat(end.minDistance()).isCloseTo(1, within(1e-6));
        assertThat(end.startTime()).isEqualTo(1000);
        assertThat(end.time()).isEqualTo(4000);
        assertThat(encounters).extracting(Encounter::id).containsOnly(end.pairId() + "@1000");
    }

    @Test
    void takesAHandOverBetweenCellsForNeitherEndNorStart() throws Exception {
        stage.receive(seen(4, 1000, 1));
        assertThat(stage.advance(1000)).extracting(Encounter::phase).containsExactly(Phase.STARTED);
        stage.receive(List.of(seen(2, 2000, 1), seen(4, 2000, -1)));
        List<Encounter> encounters = stage.advance(2000);
        assertThat(encounters).extracting(Encounter::phase).containsExactly(Phase.ONGOING);
        assertThat(encounters.get(0).distance()).isCloseTo(2, within(1e-6));
    }

    @Test
    void limitsTheRateOfOngoingRecordsButMissesNoClosestDistance() throws Exception {
        stage.receive(
                List.of(seen(4, 1000, 1), seen(1, 1999, 0), seen(3, 2000, 0), seen(2, 2999, 0), seen(2, 3500, -1)));
        List<Encounter> encounters = stage.advance(4000);
        assertThat(encounters).extracting(Encounter::time).containsExactly(1000L, 2000L, 3500L);
        assertThat(encounters.get(1).minDistance()).isCloseTo(1, within(1e-6));
    }

    @Test
    void namesTheNextEncounterOfThePairDifferently() throws Exception {
        stage.receive(List.of(seen(4, 1000, 1), seen(4, 2000, -1), seen(4, 3000, 1), seen(4, 4000, -1)));
        String pair = PairId.of("farm|/|a", "farm|/|b");
        assertThat(stage.advance(4000))
                .extracting(Encounter::id)
                .containsExactly(pair + "@1000", pair + "@1000", pair + "@3000", pair + "@3000");
    }

    @Test
    void countsWhatNoGridCanBringAbout() {
        EncounterTracker tracker = new EncounterTracker(CollisionRules.DEFAULT);
        assertThat(violations(tracker, seen(4, 1000, 1), seen(4, 2000, 0), seen(4, 3000, -1)))
                .isZero();
        assertThat(violations(tracker, seen(4, 1000, 1), seen(4, 2000, 1))).isEqualTo(1);
        assertThat(violations(tracker, seen(4, 1000, -1))).isEqualTo(1);
        assertThat(violations(tracker, seen(4, 1000, 0))).isEqualTo(1);
    }

    private static int violations(EncounterTracker tracker, PairObservation... observations) {
        return tracker.follow(null, List.of(observations), encounter -> {}).violations();
    }

    /** b at the place, a so many meters east of it. */
    private static PairObservation seen(double meters, long time, int change) {
        return new PairObservation(east("a", meters, time), east("b", 0, time), time, change);
    }
}
