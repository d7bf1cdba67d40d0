package io.furrow.bench.replay;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class TimingTest {
    private static final long ANCHOR = 5_000_000;

    private final ScheduledReplay replay = new ScheduledReplay(
            DesiredReplay.started("m", Topics.replay("m", "0a1b2c3d"), ReplayPlan.PLAIN, 1, 0, 1),
            new StoredMission("m", 3, 1, 1),
            ANCHOR);

    private static PlayedRecord event(long sequence, long after, long late) {
        long due = ANCHOR + after;
        return new PlayedRecord(sequence, StoredMission.BEGIN + after, due + 1, due + late);
    }

    @Test
    void tellsTheStartApartAndCountsWhatIsMissing() {
        Timing.Collected collected = new Timing.Collected(1_000);
        collected.add(replay, List.of(event(0, 0, 40), event(1, 999, 30), event(2, 1_000, 7)), 5);

        Timing timing = collected.timing();
        assertThat(timing.start())
                .hasValueSatisfying(start -> assertThat(start.max()).isEqualTo(40));
        assertThat(timing.steady().max()).isEqualTo(7);
        assertThat(timing.handedOver().max()).isEqualTo(1);
        assertThat(timing.missing()).isEqualTo(2);
    }

    @Test
    void makesTheSameMissionAgain() {
        StoredMission mission = new StoredMission("m", 200, 100, 7);

        assertThat(mission.all()).isEqualTo(mission.all()).hasSize(200);
        assertThat(mission.all().get(0).time()).isEqualTo(StoredMission.BEGIN);
        assertThat(mission.all()).isSortedAccordingTo((one, other) -> Long.compare(one.time(), other.time()));
    }
}
