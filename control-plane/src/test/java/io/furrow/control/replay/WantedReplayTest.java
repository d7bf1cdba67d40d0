package io.furrow.control.replay;

import java.nio.charset.StandardCharsets;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.WantedReplay;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What the manager writes to {@code service.replays} is what whoever plays replays back reads there. */
class WantedReplayTest {
    private static final String NAME = "m.0a1b2c3d";
    private static final String TOPIC = "data.m.replay.0a1b2c3d";

    private static Replay started(Long from, Long to, double speed, List<String> devices) {
        return new Replay(
                NAME,
                "m",
                TOPIC,
                from,
                to,
                ReplayCommand.json(speed),
                true,
                devices,
                Replay.Wanted.RUNNING,
                null,
                null,
                5,
                1);
    }

    @Test
    void readsAllThatTheManagerSays() throws Exception {
        Replay steered = started(10L, 20L, 0.5, List.of("urn:a", "urn:b"))
                .wanted(Replay.Wanted.PAUSED, 2)
                .stepping(3, 3)
                .jumping(15, 4)
                .at(7.5, 5);

        WantedReplay read = WantedReplay.read(NAME, steered.toBytes());

        assertThat(read)
                .isEqualTo(new WantedReplay(
                        NAME,
                        "m",
                        TOPIC,
                        10L,
                        20L,
                        7.5,
                        true,
                        List.of("urn:a", "urn:b"),
                        ReplayStatus.State.PAUSED,
                        new WantedReplay.Seek(15, 4),
                        new WantedReplay.Step(3, 3),
                        5));
        assertThat(WantedReplay.read(NAME, read.toBytes())).isEqualTo(read);
    }

    @Test
    void readsWhatTheManagerLeavesOut() throws Exception {
        WantedReplay read = WantedReplay.read(
                NAME,
                started(null, null, ReplayCommand.MAX, List.of())
                        .wanted(Replay.Wanted.STOPPED, 2)
                        .toBytes());

        assertThat(read.speed()).isEqualTo(ReplayCommand.MAX);
        assertThat(read.from()).isNull();
        assertThat(read.devices()).isEmpty();
        assertThat(read.wanted()).isEqualTo(ReplayStatus.State.STOPPED);
        assertThat(WantedReplay.read(NAME, read.toBytes())).isEqualTo(read);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            "speed":1.0          | "speed":2000        | 'speed' is neither
            "speed":1.0          | "speed":"fast"      | 'speed' is neither
            "wanted":"running"   | "wanted":"ended"    | 'wanted' is not
            "sequence":1         | "sequence":1.5      | 'sequence' is no whole number
            "loop":true          | "loop":"yes"        | 'loop' is neither
            "devices":[]         | "devices":[1]       | 'devices' is no list
            "devices":[]         | "devices":"urn:a"   | 'devices' is no list
            "topic":"data.m.replay.0a1b2c3d" | "topic":"data.raw" | do not belong together
            "mission":"m"        | "mission":"n"       | do not belong together
            "replay":"m.0a1b2c3d" | "replay":"m.0a1b2c3e" | do not belong together
            "created":5          | "seek":{"to":1}     | 'sequence' is no whole number
            "created":5          | "from":"now"        | 'from' is no whole number
            """)
    void refusesWhatNoManagerWrites(String member, String other, String reason) {
        String json = new String(started(null, null, 1, List.of()).toBytes(), StandardCharsets.UTF_8);
        assertThat(json).contains(member);
        byte[] changed = json.replace(member, other).getBytes(StandardCharsets.UTF_8);

        assertThatThrownBy(() -> WantedReplay.read(NAME, changed))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining(reason);
    }
}
