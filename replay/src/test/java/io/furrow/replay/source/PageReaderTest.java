package io.furrow.replay.source;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.mission.Cursor;
import io.furrow.mission.PageLimits;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.topic.Topics;
import io.furrow.replay.playback.ReadRequest;
import io.furrow.replay.playback.ReadResult;
import io.furrow.replay.recording.PageBudget;
import io.furrow.replay.recording.RecordingSources;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class PageReaderTest {
    private static final long TIME = 1_700_000_000_000L;

    private final MemoryRecordings missions = new MemoryRecordings().with("m", TIME, TIME + 10, TIME + 20, TIME + 30);
    private final List<ReadResult> answers = new CopyOnWriteArrayList<>();

    @AutoClose
    private final PageReader pages = new PageReader(
            DesiredReplay.started("m", Topics.replay("m", "0a1b2c3d"), ReplayPlan.PLAIN, 1, 0, 1),
            () -> {},
            new RunningReplay.Reading(
                    RecordingSources.of(missions),
                    new PageBudget(new PageLimits(2, 1_000)),
                    new OnePartition(),
                    null,
                    null,
                    ReplayClock.SYSTEM,
                    replay -> {}),
            answers::add);

    @Test
    void abandonsASeekForANewerOne() {
        missions.block(true);
        pages.read(seek(1, TIME + 20));
        await().until(() -> missions.blocked() == 1);

        missions.block(false);
        pages.read(seek(2, TIME + 30));

        await().until(() -> !answers.isEmpty());
        assertThat(answers).singleElement().isInstanceOfSatisfying(ReadResult.Primed.class, primed -> {
            assertThat(primed.epoch()).isEqualTo(2);
            assertThat(primed.primes()).hasSize(1);
        });
        assertThat(missions.blocked()).isZero();
    }

    @Test
    void readsNothingAfterItWasClosed() {
        missions.block(true);
        pages.read(seek(1, TIME + 20));
        await().until(() -> missions.blocked() == 1);

        pages.close();

        await().until(() -> missions.blocked() == 0 && missions.open() == 0);
        assertThat(answers).isEmpty();
    }

    private static ReadRequest seek(long epoch, long point) {
        return new ReadRequest.Begin(epoch, point, Cursor.before(point), true, true, 2);
    }
}
