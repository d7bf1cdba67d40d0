package io.furrow.analytics.collision.matching;

import java.io.IOException;
import java.util.HexFormat;
import java.util.List;

import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.encounter.PairObservationSerializer;
import io.furrow.analytics.collision.encounter.PendingObservationsSerializer;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.CellUpdateSerializer;
import io.furrow.analytics.collision.grid.PendingFixesSerializer;
import io.furrow.analytics.collision.grid.Presence;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.collision.grid.TrackSerializer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.format.Format;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Bytes as older versions wrote them, which no newer one changes. */
class OlderFormatsTest {
    /** A position fix in its version 1, as it stood without that number in other values. */
    private static final String A =
            "00391dd8000000100174047c2f7c61000000010152016d004044400000000000c00a0000000000003ff80000000000004056"
                    + "80000000000000000000000003e8";

    private static final String B =
            "00391dd9000000140174047c2f7c62000000010152016d047c2f7c614044400000000000c00a000000000000000000000000"
                    + "0000000000000000000000000000000003e8";

    private static final PositionFix FIRST =
            new PositionFix("t", "|/|a", "a", "R", "m", "", 40.5, -3.25, 1.5, 90, 1000);
    private static final PositionFix SECOND =
            new PositionFix("t", "|/|b", "b", "R", "m", "|/|a", 40.5, -3.25, 0, 0, 1000);

    private static final String UPDATE = "fffffffffffffff900000000000003e801" + A;
    private static final String SIGHTING = A + B + "00000000000003e8ff";
    private static final String TRACK = A + "000000020000000000000003fffffffffffffffc";
    private static final String CELL = "0000000201" + A + "02" + B + "00000001047c2f7c610100000000000003e801" + B;

    @Test
    void areReadInVersion1() throws Exception {
        assertThat(read(new CellUpdateSerializer(), 1, UPDATE))
                .isEqualTo(new CellUpdate(-7, 1000, Presence.HALO, FIRST));
        assertThat(read(new PairObservationSerializer(), 1, SIGHTING))
                .isEqualTo(new PairObservation(FIRST, SECOND, 1000, -1));
        Track track = read(new TrackSerializer(), 1, TRACK);
        assertThat(track.last()).isEqualTo(FIRST);
        assertThat(track.cells()).containsExactly(3, -4);
    }

    @Test
    void areReadInVersion2WhereThereWereTwo() throws Exception {
        Cell cell = read(new CellSerializer(), 2, CELL);
        assertThat(cell.members()).extracting(Member::fix).containsExactlyInAnyOrder(FIRST, SECOND);
        assertThat(cell.report()).isEqualTo(new CrowdReport(1000, true, SECOND));
    }

    @Test
    void areReadWithWhatWaitsForThem() throws Exception {
        areWrittenAnew(new PendingUpdatesSerializer(), 2, "00000001" + UPDATE + "01" + CELL);
        areWrittenAnew(new PendingFixesSerializer(), 1, "00000001" + A + "01" + TRACK);
        areWrittenAnew(new PendingObservationsSerializer(), 1, "00000001" + SIGHTING + "00");
        areWrittenAnew(new PendingObservationsSerializer(), 1, "0000000000");
    }

    /** Read as what they were and as what they are then, they are the same. */
    private static <T> void areWrittenAnew(Format<T> format, int version, String older) throws IOException {
        String now = written(format, read(format, version, older));
        assertThat(written(format, read(format, format.version(), now))).isEqualTo(now);
        assertThat(format.version()).isEqualTo(3);
    }

    @Test
    void areRefusedInAVersionThatIsUnknown() {
        for (Format<?> format : List.of(
                new CellUpdateSerializer(),
                new PairObservationSerializer(),
                new TrackSerializer(),
                new CellSerializer(),
                new PendingUpdatesSerializer())) {
            for (int version : new int[] {0, format.version() + 1}) {
                assertThatThrownBy(() -> read(format, version, "00000000"))
                        .isInstanceOf(IOException.class)
                        .hasMessageContaining("was written in version " + version);
            }
        }
    }

    @Test
    void holdTheirPartsBehindTheVersionOfEach() throws Exception {
        String now = written(new TrackSerializer(), new Track(FIRST, new long[] {3, -4}));

        assertThat(now).isEqualTo("01" + TRACK);
        assertThatThrownBy(() -> read(new TrackSerializer(), 2, "09" + TRACK))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("PositionFix was written in version 9");
    }

    @ParameterizedTest
    @EnumSource
    void knowAPresenceByItsCode(Presence presence) throws Exception {
        assertThat(Presence.of(presence.code())).isEqualTo(presence);
        assertThatThrownBy(() -> Presence.of(9)).isInstanceOf(IOException.class);
    }

    /** All of it, or it fails. */
    private static <T> T read(Format<T> format, int version, String bytes) throws IOException {
        DataInputDeserializer in = new DataInputDeserializer(HexFormat.of().parseHex(bytes));
        T read = format.read(version, in);
        assertThat(in.available()).isZero();
        return read;
    }

    private static <T> String written(Format<T> format, T value) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(256);
        format.write(value, out);
        return HexFormat.of().formatHex(out.getCopyOfBuffer());
    }
}
