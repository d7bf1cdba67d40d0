package io.furrow.analytics.collision.grid;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.collision.encounter.Stage;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class TrackDevicesTest {
    private static final CollisionRules RULES =
            new CollisionRules(5, Duration.ofSeconds(3), Duration.ZERO, Duration.ZERO, 100);

    private final Grid grid = new Grid(RULES);
    private Stage<Device, PositionFix, CellUpdate> stage;

    @BeforeEach
    void start() throws Exception {
        stage = Stage.track(RULES);
    }

    @AfterEach
    void leaveNothing() throws Exception {
        stage.advance(Long.MAX_VALUE);
        stage.stopEmpty();
    }

    @Test
    void movesADeviceFromCellToCell() throws Exception {
        PositionFix here = east("a", 50, 1000);
        PositionFix there = east("a", 950, 2000);
        stage.receive(List.of(there, here));
        assertThat(stage.advance(999)).isEmpty();
        assertThat(stage.advance(1999)).containsExactlyElementsOf(arrival(here));
        List<CellUpdate> expected = new ArrayList<>();
        for (long cell : cells(here)) {
            expected.add(new CellUpdate(cell, 2000, CellPresence.GONE, here));
        }
        expected.addAll(arrival(there));
        assertThat(stage.advance(2000)).containsExactlyElementsOf(expected);
    }

    @Test
    void removesADeviceExactlyWhenItsTimeToLiveEnds() throws Exception {
        PositionFix fix = east("a", 50, 1000);
        stage.receive(fix);
        assertThat(stage.advance(3999)).hasSameSizeAs(cells(fix));
        assertThat(stage.advance(4000))
                .hasSameSizeAs(cells(fix))
                .allMatch(update -> update.cellPresence() == CellPresence.GONE && update.time() == 4000);
        assertThat(stage.stateEntries()).isZero();
    }

    @Test
    void removesASilentDeviceAtItsOwnTimeHoweverFarTheWatermarkJumps() throws Exception {
        stage.receive(List.of(east("a", 50, 1000), east("a", 50, 9000)));
        assertThat(stage.advance(20_000)).extracting(CellUpdate::time).containsOnly(1000L, 4000L, 9000L, 12_000L);
    }

    @Test
    void staysWhenThePositionIsRenewedAtTheVeryEndOfItsTimeToLive() throws Exception {
        stage.receive(List.of(east("a", 50, 1000), east("a", 50, 4000)));
        assertThat(stage.advance(6999)).noneMatch(update -> update.cellPresence() == CellPresence.GONE);
    }

    @Test
    void takesTheGreaterOfTwoPositionsOfOneInstant() throws Exception {
        PositionFix greater = east("a", 950, 1000);
        stage.receive(List.of(greater, east("a", 50, 1000), greater));
        assertThat(stage.advance(1000)).containsExactlyElementsOf(arrival(greater));
    }

    @Test
    void sendsWhatTheWatermarkHasPassedToTheSideOutput() throws Exception {
        stage.receive(east("a", 50, 1000));
        assertThat(stage.advance(1000)).isNotEmpty();
        PositionFix late = east("b", 60, 1000);
        PositionFix inTime = east("b", 60, 1001);
        stage.receive(List.of(late, inTime));
        assertThat(stage.side(TrackDevices.LATE)).containsExactly(late);
        assertThat(stage.advance(1001)).containsExactlyElementsOf(arrival(inTime));
    }

    @Test
    void showsTheLatePositionsThatAreTheNewestOfTheirDevice() throws Exception {
        stage.receive(List.of(east("a", 50, 1000), east("b", 50, 1500)));
        stage.advance(1200);
        stage.receive(List.of(east("a", 50, 900), east("a", 50, 1100), east("b", 50, 1100), east("c", 50, 1150)));

        assertThat(stage.side(TrackDevices.LATE)).hasSize(4);
        assertThat(stage.side(TrackDevices.LAGGING))
                .extracting(LaggingPosition::id, LaggingPosition::reached, LaggingPosition::counted)
                .containsExactly(tuple("a", 1200L, 1000L), tuple("c", 1200L, Long.MIN_VALUE));
    }

    @Test
    void letsNoMorePositionsOfADeviceWaitThanItHasRoomFor() throws Exception {
        for (int i = 0; i <= TrackDevices.MAX_WAITING; i++) {
            stage.receive(east("a", 50, 1000 + i));
        }
        PositionFix other = east("b", 50, 1000);
        stage.receive(other);

        assertThat(stage.side(TrackDevices.LATE)).containsExactly(east("a", 50, 1000 + TrackDevices.MAX_WAITING));
        assertThat(stage.advance(1000)).hasSize(2 * cells(other).length);
    }

    @Test
    void knowsWhatIsLateAlsoAfterARestart() throws Exception {
        stage.receive(east("a", 50, 2000));
        assertThat(stage.advance(2500)).isNotEmpty();
        stage.restart();
        PositionFix late = east("b", 60, 2500);
        stage.receive(List.of(late, east("b", 60, 2501)));
        assertThat(stage.side(TrackDevices.LATE)).containsExactly(late);
        assertThat(stage.advance(3000)).extracting(CellUpdate::time).containsOnly(2501L);
    }

    @Test
    void forgetsInTheNextCheckpointWhomItHadSavedAndRemembersWhoCameBack() throws Exception {
        stage.receive(List.of(east("a", 50, 1000), east("b", 50, 1000)));
        stage.advance(1000);
        assertThat(stage.stateEntries()).isEqualTo(2);
        stage.advance(4000);
        stage.receive(east("b", 50, 5000));
        stage.advance(5000);
        assertThat(stage.stateEntries()).isEqualTo(1);
        stage.restart();
        assertThat(stage.advance(8000))
                .isNotEmpty()
                .allMatch(update -> update.cellPresence() == CellPresence.GONE && update.time() == 8000);
    }

    @Test
    void keepsWhatWaitsHoweverTheWatermarkCutsIt() throws Exception {
        List<PositionFix> fixes = new ArrayList<>();
        for (int i = 0; i < 50; i++) {
            fixes.add(east("a", i, 1000 + 100 * i));
        }
        Collections.shuffle(fixes, new Random(3));
        stage.receive(fixes);
        List<Long> times = new ArrayList<>();
        for (long watermark = 950; watermark < 6200; watermark += 170) {
            stage.advance(watermark).stream().map(CellUpdate::time).distinct().forEach(times::add);
            stage.restart();
        }
        assertThat(times)
                .containsExactlyElementsOf(
                        fixes.stream().map(PositionFix::time).sorted().toList());
    }

    private long[] cells(PositionFix fix) {
        return grid.cells(fix.latitude(), fix.longitude());
    }

    private List<CellUpdate> arrival(PositionFix fix) {
        List<CellUpdate> updates = new ArrayList<>();
        for (long cell : cells(fix)) {
            updates.add(new CellUpdate(
                    cell, fix.time(), updates.isEmpty() ? CellPresence.RESIDENT : CellPresence.HALO, fix));
        }
        return updates;
    }
}
