package io.furrow.replay.source;

import java.io.IOException;
import java.util.Arrays;
import java.util.HexFormat;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.mission.Cursor;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.playback.PlaybackStates;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ReplaySplitSerializerTest {
    /** Offset of the phase, behind name, record and sequence. */
    private static final int PHASE_AT = 28;

    private final ReplaySplitSerializer serializer = new ReplaySplitSerializer();

    private static ReplaySplit split(PlaybackState.Phase phase, String reason, Long start) {
        return split(phase, reason, start, new Cursor(15, "g"));
    }

    private static ReplaySplit split(PlaybackState.Phase phase, String reason, Long start, Cursor goal) {
        return new ReplaySplit("m.0a1b2c3d", new byte[] {1, 2}, PlaybackStates.of(phase, reason, start, goal));
    }

    @ParameterizedTest
    @EnumSource(PlaybackState.Phase.class)
    void readsBackASplit(PlaybackState.Phase phase) throws Exception {
        for (ReplaySplit split : List.of(split(phase, null, -1L, null), split(phase, "why", null))) {
            assertThat(serializer.deserialize(serializer.getVersion(), serializer.serialize(split)))
                    .usingRecursiveComparison()
                    .isEqualTo(split);
        }
    }

    /** Savepoints contain these bytes. */
    @Test
    void writesTheBytesOfItsVersion() throws Exception {
        byte[] stored = HexFormat.of()
                .parseHex("0000000a6d2e3061316232633364" + "000000020102" + "0000000000000001" + "02" + "00000003776879"
                        + "0000000000000002" + "0000000000000003" + "0000000000000004" + "0000000000000005" + "01"
                        + "ffffffffffffffff" + "0000000000000006" + "0000000000000007" + "00000002c3b1"
                        + "0000000000000008" + "0000000000000009" + "000000000000000a" + "000000000000000b"
                        + "000000000000000c" + "000000000000000d" + "000000000000000e" + "000000000000000f"
                        + "0000000167");

        assertThat(serializer.serialize(split(PlaybackState.Phase.PLAYING, "why", -1L)))
                .isEqualTo(stored);
        stored[PHASE_AT] = 9;
        assertThatThrownBy(() -> serializer.deserialize(2, stored))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("code 9");
    }

    @Test
    void keepsTheCodesOfPhases() {
        assertThat(PlaybackState.Phase.values())
                .extracting(phase -> phase.code() + " " + phase)
                .containsExactly(
                        "0 OPENING", "1 PRIMING", "2 PLAYING", "3 BETWEEN", "4 ENDED", "5 STOPPED", "6 FAILED");
    }

    @Test
    void rejectsOtherVersionsAndTrailingBytes() throws Exception {
        byte[] bytes = serializer.serialize(split(PlaybackState.Phase.PLAYING, null, null));

        for (int version : new int[] {1, 3}) {
            assertThatThrownBy(() -> serializer.deserialize(version, bytes))
                    .isInstanceOf(IOException.class)
                    .hasMessageContaining("version " + version);
        }
        assertThatThrownBy(() -> serializer.deserialize(2, Arrays.copyOf(bytes, bytes.length + 1)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("1 bytes follow");
    }

    @Test
    void readsBackReplaysWithoutAReader() throws Exception {
        EnumeratorStateSerializer all = new EnumeratorStateSerializer();
        EnumeratorState replays = new EnumeratorState(
                List.of(split(PlaybackState.Phase.PLAYING, null, null), split(PlaybackState.Phase.ENDED, "x", 1L)));

        byte[] bytes = all.serialize(replays);

        assertThat(all.deserialize(all.getVersion(), bytes))
                .usingRecursiveComparison()
                .isEqualTo(replays);
        assertThatThrownBy(() -> all.deserialize(all.getVersion(), Arrays.copyOf(bytes, bytes.length + 1)))
                .isInstanceOf(IOException.class);
    }
}
