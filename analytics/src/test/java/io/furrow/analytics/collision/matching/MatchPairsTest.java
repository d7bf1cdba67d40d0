package io.furrow.analytics.collision.matching;

import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.encounter.Stage;
import io.furrow.analytics.collision.grid.CellPresence;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;

class MatchPairsTest {
    private static final long CELL = 7;

    private Stage<Long, CellUpdate, PairObservation> stage;

    @BeforeEach
    void start() throws Exception {
        stage = Stage.match(CollisionRules.DEFAULT);
    }

    @AfterEach
    void leaveNothing() throws Exception {
        stage.receive(List.of(gone(east("a", 0, 9000)), gone(east("b", 0, 9000)), gone(east("c", 0, 9000))));
        stage.advance(9000);
        stage.stopEmpty();
    }

    @Test
    void seesAPairComeStayAndGoWithThePlacesOfBoth() throws Exception {
        stage.receive(List.of(resident(east("b", 0, 1000)), resident(east("a", 100, 1000))));
        assertThat(stage.advance(1000)).isEmpty();
        stage.receive(resident(east("a", 4, 2000)));
        assertThat(stage.advance(2000))
                .containsExactly(new PairObservation(east("a", 4, 2000), east("b", 0, 1000), 2000, 1));
        stage.receive(resident(east("b", 1, 3000)));
        assertThat(stage.advance(3000))
                .containsExactly(new PairObservation(east("a", 4, 2000), east("b", 1, 3000), 3000, 0));
        stage.receive(resident(east("a", 8, 4000)));
        assertThat(stage.advance(4000))
                .containsExactly(new PairObservation(east("a", 4, 2000), east("b", 1, 3000), 4000, -1));
    }

    @Test
    void appliesAllOfOneInstantAtOnceAndInstantsInOrder() throws Exception {
        // Both leave together: never apart. In between they were 100 m apart, if one looked too early.
        stage.receive(List.of(
                resident(east("a", 100, 2000)),
                resident(east("b", 2, 1000)),
                resident(east("a", 0, 1000)),
                resident(east("b", 102, 2000))));
        assertThat(stage.advance(2000))
                .extracting(PairObservation::time, PairObservation::change)
                .containsExactly(
                        org.assertj.core.groups.Tuple.tuple(1000L, 1), org.assertj.core.groups.Tuple.tuple(2000L, 0));
    }

    @Test
    void endsAPairWhenEitherLeavesTheCell() throws Exception {
        stage.receive(List.of(resident(east("a", 0, 1000)), halo(east("b", 2, 1000)), resident(east("c", 3, 1000))));
        assertThat(stage.advance(1000)).hasSize(3);
        stage.receive(gone(east("b", 2, 2000)));
        assertThat(stage.advance(2000)).hasSize(2).allMatch(observation -> observation.change() == -1);
        stage.receive(List.of(gone(east("a", 0, 3000)), gone(east("c", 3, 3000))));
        assertThat(stage.advance(3000)).hasSize(1).allMatch(observation -> observation.change() == -1);
        assertThat(stage.stateEntries()).isZero();
    }

    @Test
    void goesOnAfterARestartWithWhatWaitsAndWhoIsThere() throws Exception {
        stage.receive(resident(east("a", 0, 1000)));
        stage.advance(1000);
        stage.receive(resident(east("b", 2, 2000)));
        stage.restart();
        assertThat(stage.advance(2000)).extracting(PairObservation::change).containsExactly(1);
    }

    private static CellUpdate resident(PositionFix fix) {
        return new CellUpdate(CELL, fix.time(), CellPresence.RESIDENT, fix);
    }

    private static CellUpdate halo(PositionFix fix) {
        return new CellUpdate(CELL, fix.time(), CellPresence.HALO, fix);
    }

    private static CellUpdate gone(PositionFix fix) {
        return new CellUpdate(CELL, fix.time(), CellPresence.GONE, fix);
    }
}
