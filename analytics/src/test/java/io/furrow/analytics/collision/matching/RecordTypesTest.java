package io.furrow.analytics.collision.matching;

import java.util.List;

import org.apache.flink.api.java.typeutils.runtime.PojoSerializer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.analytics.Serializers;
import io.furrow.analytics.collision.Fixes;
import io.furrow.analytics.collision.debounce.SteadyState;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.OpenEncounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.grid.CellPresence;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class RecordTypesTest {
    private static final PositionFix FIX = Fixes.carriedBy("b", Fixes.at("a", 40.5, -3.25, 1000));

    private static final Pair PAIR = new Pair("t", "farm|/|a", "farm|/|b");

    static Object[] records() {
        return new Object[] {
            PAIR,
            new Device("t", "farm|/|a"),
            FIX,
            new PositionFix("t", "farm|/|T|somebody", "else", "", "é", "", -90, 180, 1.5, 270, Long.MIN_VALUE),
            new PositionFix("t", "farm|/|" + "x".repeat(300), "x".repeat(300), "", "", "", 0, 1, 0, 0, 0),
            new CellUpdate(-7, 1000, CellPresence.HALO, FIX),
            new PairObservation(FIX, FIX, 1000, -1),
            new OpenEncounter(500, 1.5, 1000, FIX, FIX)
        };
    }

    @ParameterizedTest
    @MethodSource("records")
    void goThroughTheirFormats(Object written) throws Exception {
        assertThat(Serializers.copied(written)).isEqualTo(written);
        assertThat(Serializers.of(written)).isNotInstanceOf(PojoSerializer.class);
    }

    static Object[] plainRecords() {
        return new Object[] {
            new Encounter(Phase.ENDED, FIX, FIX, 4.5, 1.5, 500, 1000),
            new SteadyState(new Encounter(Phase.STARTED, FIX, FIX, 4.5, 1.5, 500, 1000), true, 900),
            new CellOverflow(FIX, -7, 40, -3, 9, 4, 1, 2, 1000)
        };
    }

    @ParameterizedTest
    @MethodSource("plainRecords")
    void goThroughFlinksOwnSerializer(Object written) throws Exception {
        Serializers.assertPlain(written);
    }

    @Test
    void tracksGoThroughTheirFormat() throws Exception {
        Track track = Serializers.copied(new Track(FIX, new long[] {3, -4}));
        assertThat(track.last()).isEqualTo(FIX);
        assertThat(track.cells()).containsExactly(3, -4);
    }

    @Test
    void cellsGoThroughTheirFormatAndAreCopiedBeforeTheyChange() throws Exception {
        Cell cell = Cell.empty();
        cell.put(CellEntry.of(FIX, true));
        cell.put(inACrowd(Fixes.east("c", 3, 500)));
        cell.report(new CrowdReport(1000, true, FIX));
        assertThat(Serializers.copied(cell).report()).isEqualTo(cell.report());
        assertThat(Serializers.copied(cell).isCrowded()).isTrue();
        assertThat(Serializers.copied(cell).members()).containsExactlyInAnyOrderElementsOf(cell.members());
        Cell copy = Serializers.of(cell).copy(cell);
        copy.put(CellEntry.of(Fixes.east("d", 3, 500), false));
        copy.report(null);
        assertThat(copy.members()).hasSize(3);
        assertThat(cell.members()).hasSize(2);
        assertThat(cell.report()).isNotNull();
    }

    private static CellEntry inACrowd(PositionFix fix) {
        CellEntry cellEntry = CellEntry.of(fix, false);
        cellEntry.shortlist(new NearestNeighbors(List.of("farm|/|a", "farm|/|é")));
        return cellEntry;
    }
}
