package io.furrow.model.control;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Checks that players of replays read what the manager writes to {@code service.replays}. */
class DesiredReplayTest {
    private static final String NAME = "m.0a1b2c3d";
    private static final String TOPIC = "data.m.replay.0a1b2c3d";

    private static DesiredReplay started(ReplayPlan plan) {
        return DesiredReplay.started("m", TOPIC, plan, 1, 5, 1);
    }

    @Test
    void readsAllMembersOfTheManager() throws Exception {
        ReplayPlan plan = new ReplayPlan(
                new ReplayPlan.Source("data.field", null),
                10L,
                20L,
                true,
                List.of("urn:a", "urn:b"),
                1500L,
                ReplayPlan.Stamps.NOW,
                77L,
                List.of("collision", "temperature"));
        DesiredReplay steered = DesiredReplay.started("m", "data.other.replay.0a1b2c3d", plan, 0.5, 5, 1)
                .desired(ReplayStatus.State.PAUSED, 2)
                .stepping(3, 3)
                .stepping(-5, 3)
                .seeking(15, 4)
                .within(new DesiredReplay.Range(12, 18), 5)
                .following("01234567", new DesiredReplay.Clock(100, 12))
                .at(7.5, 6);

        DesiredReplay read = DesiredReplay.read(NAME, steered.toBytes());

        assertThat(read).isEqualTo(steered);
        assertThat(read.plan()).isEqualTo(plan);
        assertThat(read.step()).isEqualTo(new DesiredReplay.Step(-2, 3));
        assertThat(read.sequence()).isEqualTo(6);
    }

    @Test
    void readsRecordsWithoutOptionalMembers() throws Exception {
        DesiredReplay written =
                started(ReplayPlan.PLAIN).at(ReplayCommand.MAX, 2).desired(ReplayStatus.State.STOPPED, 2);

        DesiredReplay read = DesiredReplay.read(NAME, written.toBytes());

        assertThat(read).isEqualTo(written);
        assertThat(read.speed()).isEqualTo(ReplayCommand.MAX);
        assertThat(read.plan()).isEqualTo(ReplayPlan.PLAIN);
    }

    @Test
    void playsTheIntersectionOfPlanAndRange() {
        DesiredReplay plain = started(ReplayPlan.PLAIN);
        DesiredReplay part = started(ReplayPlan.PLAIN.between(10, 20));

        assertThat(plain.from(7)).isEqualTo(7);
        assertThat(plain.to()).isEqualTo(Long.MAX_VALUE);
        assertThat(plain.loops()).isFalse();
        assertThat(part.from(7)).isEqualTo(10);
        assertThat(part.from(12)).isEqualTo(12);
        assertThat(part.within(new DesiredReplay.Range(5, 15), 2).from(7)).isEqualTo(10);
        assertThat(part.within(new DesiredReplay.Range(12, 15), 2).from(7)).isEqualTo(12);
        assertThat(part.within(new DesiredReplay.Range(12, 15), 2).to()).isEqualTo(15);
        assertThat(part.within(new DesiredReplay.Range(12, 25), 2).to()).isEqualTo(20);
        assertThat(part.within(new DesiredReplay.Range(12, 25), 2).loops()).isTrue();
    }

    @Test
    void computesItsPositionFromTheClockOfItsGroup() {
        DesiredReplay once = started(ReplayPlan.PLAIN.between(1000, 2000))
                .at(2, 2)
                .following("01234567", new DesiredReplay.Clock(50_000, 1100));

        assertThat(once.position(49_000)).as("before the moment").isEqualTo(1100);
        assertThat(once.position(50_100)).isEqualTo(1300);
        assertThat(once.position(60_000)).as("at the end").isEqualTo(2000);
        assertThat(once.desired(ReplayStatus.State.PAUSED, 3).position(50_100)).isEqualTo(1100);
    }

    @ParameterizedTest
    @CsvSource({
        "50000, 900", // before the repeated range
        "50100, 1100",
        "50549, 1998",
        "50550, 1000",
        "50600, 1100",
        "51049, 1998",
        "51050, 1000",
        "1000000050000, 1900", // 2e12 ms later
    })
    void restartsAtTheEndOfARepeatedRange(long now, long position) {
        DesiredReplay.Range loop = new DesiredReplay.Range(1000, 2000);
        DesiredReplay.Clock clock = new DesiredReplay.Clock(50_000, 900);

        assertThat(clock.position(now, 2, loop)).isEqualTo(position);
        assertThat(started(ReplayPlan.PLAIN.between(0, 5000))
                        .at(2, 2)
                        .within(loop, 3)
                        .following("01234567", clock)
                        .position(now))
                .isEqualTo(position);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            "speed":1.0          | "speed":2000        | 'speed' must be a number from 0.1
            "speed":1.0          | "speed":"fast"      | 'speed' must be a number from 0.1
            "wanted":"running"   | "wanted":"ended"    | 'wanted' must be running
            "sequence":1         | "sequence":1.5      | 'sequence' must be a whole number
            "loop":false         | "loop":"yes"        | 'loop' must be true or false
            "created":5          | "devices":[1]       | 'devices' must be a list
            "created":5          | "devices":"urn:a"   | 'devices' must be a list
            "created":5          | "stamps":"soon"     | 'stamps' must be original or now
            "created":5          | "analytics":["x"]   | 'analytics' must be a list of collision
            "created":5          | "source":{}         | 'source' must be an object with either
            "created":5          | "source":{"file":"../x"} | 'file' must be the name of a file
            "created":5          | "source":{"topic":"service.audit"} | 'topic' must be a topic that begins
            "created":5          | "range":{"from":2,"to":2} | 'to' must be after 'from'
            "topic":"data.m.replay.0a1b2c3d" | "topic":"data.raw" | do not belong together
            "topic":"data.m.replay.0a1b2c3d" | "topic":"data.m.replay.0a1b2c3e" | do not belong together
            "mission":"m"        | "mission":"n"       | do not belong together
            "replay":"m.0a1b2c3d" | "replay":"m.0a1b2c3e" | do not belong together
            "created":5          | "seek":{"to":1}     | 'sequence' must be a whole number
            "created":5          | "from":"now"        | 'from' must be a time
            """)
    void rejectsInvalidRecords(String member, String other, String reason) {
        String json = new String(started(ReplayPlan.PLAIN).toBytes(), UTF_8);
        assertThat(json).contains(member);
        byte[] changed = json.replace(member, other).getBytes(UTF_8);

        assertThatThrownBy(() -> DesiredReplay.read(NAME, changed))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining(reason);
    }

    @Test
    void rejectsTheRecordOfAnotherReplay() {
        assertThatThrownBy(() -> DesiredReplay.read(
                        "m.0a1b2c3e", started(ReplayPlan.PLAIN).toBytes()))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("m.0a1b2c3e");
    }
}
