package io.furrow.analytics.collision.grid;

import java.io.IOException;
import java.util.HexFormat;
import java.util.List;

import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.analytics.collision.encounter.OpenEncounterSerializer;
import io.furrow.analytics.collision.encounter.PairObservationSerializer;
import io.furrow.analytics.collision.encounter.PendingObservationsSerializer;
import io.furrow.analytics.collision.matching.CellSerializer;
import io.furrow.analytics.collision.matching.PendingUpdatesSerializer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.format.VersionedSerializer;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** A format reads the version that it writes, and refuses every other. */
class FormatVersionsTest {
    private static final PositionFix FIX = new PositionFix("t", "|/|a", "a", "R", "m", "", 40.5, -3.25, 1.5, 90, 1000);
    /** A {@link Track} of it, in version 2, with the fix as a part in version 1. */
    private static final String TRACK =
            "0100391dd8000000100174047c2f7c61000000010152016d004044400000000000c00a0000000000003ff80000000000004056"
                    + "80000000000000000000000003e8000000020000000000000003fffffffffffffffc";

    @Test
    void refuseEveryOtherVersion() {
        for (VersionedSerializer<?> versionedSerializer : List.of(
                new CellUpdateSerializer(),
                new PairObservationSerializer(),
                new OpenEncounterSerializer(),
                new TrackSerializer(),
                new CellSerializer(),
                new PendingFixesSerializer(),
                new PendingObservationsSerializer(),
                new PendingUpdatesSerializer())) {
            for (int version : new int[] {0, versionedSerializer.version() - 1, versionedSerializer.version() + 1}) {
                assertThatThrownBy(() -> read(versionedSerializer, version, "00000000"))
                        .isInstanceOf(IOException.class)
                        .hasMessageContaining("was written in version " + version);
            }
        }
    }

    @Test
    void holdTheirPartsBehindTheVersionOfEach() throws Exception {
        assertThat(written(new TrackSerializer(), new Track(FIX, new long[] {3, -4})))
                .isEqualTo(TRACK);
        Track track = read(new TrackSerializer(), 2, TRACK);
        assertThat(track.last()).isEqualTo(FIX);
        assertThat(track.cells()).containsExactly(3, -4);
        assertThatThrownBy(() -> read(new TrackSerializer(), 2, "09" + TRACK.substring(2)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("PositionFix was written in version 9");
    }

    @ParameterizedTest
    @EnumSource
    void knowAPresenceByItsCode(CellPresence cellPresence) throws Exception {
        assertThat(CellPresence.of(cellPresence.code())).isEqualTo(cellPresence);
        assertThatThrownBy(() -> CellPresence.of(9)).isInstanceOf(IOException.class);
    }

    /** All of it, or it fails. */
    private static <T> T read(VersionedSerializer<T> versionedSerializer, int version, String bytes)
            throws IOException {
        DataInputDeserializer in = new DataInputDeserializer(HexFormat.of().parseHex(bytes));
        T read = versionedSerializer.read(version, in);
        assertThat(in.available()).isZero();
        return read;
    }

    private static <T> String written(VersionedSerializer<T> versionedSerializer, T value) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(256);
        versionedSerializer.write(value, out);
        return HexFormat.of().formatHex(out.getCopyOfBuffer());
    }
}
