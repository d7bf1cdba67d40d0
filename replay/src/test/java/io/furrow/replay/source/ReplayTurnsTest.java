package io.furrow.replay.source;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.LongStream;

import org.apache.flink.api.connector.source.ReaderOutput;
import org.apache.flink.core.io.InputStatus;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.recording.RecordingSources;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Tests how replays share a reader's thread. Each record takes some time of a clock that the test drives. */
class ReplayTurnsTest {
    private static final long TIME = 1_700_000_000_000L;
    private static final int EVENTS = 1_000;

    private final AtomicLong nanos = new AtomicLong();
    private final MemoryRecordings missions = new MemoryRecordings();
    private final FakeContext context = new FakeContext();
    private final List<TopicRecord> records = new ArrayList<>();

    @AutoClose
    private final ReplayReader reader = new ReplayReader(
            context,
            RecordingSources.of(missions),
            new PageLimits(EVENTS, 1_000_000),
            new OnePartition(),
            new ReplayClock(nanos::get));

    private long microsPerRecord;
    private final ReaderOutput<TopicRecord> output = new FakeContext.Output(record -> {
        records.add(record);
        nanos.addAndGet(TimeUnit.MICROSECONDS.toNanos(microsPerRecord));
    });

    ReplayTurnsTest() {
        reader.start();
    }

    /** Adds a paused replay and waits until its first page is read. */
    private DesiredReplay ready(String mission, double speed) throws Exception {
        DesiredReplay paused = ReplayReaderTest.desired(mission, speed, State.PAUSED, 1);
        reader.addSplits(List.of(new ReplaySplit(paused.replay(), paused.toBytes(), new PlaybackState())));
        await().until(() -> {
            while (reader.pollNext(output) == InputStatus.MORE_AVAILABLE) {
                assertThat(played()).isEmpty();
            }
            return reader.snapshotState(1).stream()
                    .allMatch(split -> split.state().phase() == PlaybackState.Phase.PLAYING);
        });
        return paused;
    }

    private void resume(DesiredReplay paused) {
        reader.handleSourceEvents(new ReplayChangeEvent(
                paused.replay(), paused.desired(State.RUNNING, 2).toBytes()));
    }

    /** Returns the mission of each played event. */
    private List<String> played() {
        return records.stream()
                .filter(record -> "event".equals(record.headers().get(HeaderNames.REPLAY_KIND)))
                .map(record -> record.topic().split("\\.")[1])
                .toList();
    }

    @Test
    void returnsAfterAMillisecondThoughMoreIsDue() throws Exception {
        missions.with("m", LongStream.range(TIME, TIME + EVENTS).toArray());
        resume(ready("m", ReplayCommand.MAX));
        microsPerRecord = 100;

        assertThat(reader.pollNext(output)).isEqualTo(InputStatus.MORE_AVAILABLE);

        assertThat(played()).hasSizeBetween(10, 30);
    }

    @Test
    void playsDueEventsBetweenTheTurnsOfFasterReplays() throws Exception {
        missions.with("fast1", LongStream.range(TIME, TIME + EVENTS).toArray());
        missions.with("fast2", LongStream.range(TIME, TIME + EVENTS).toArray());
        missions.with("slow", TIME + 3, TIME + 5);
        var replays = List.of(ready("fast1", ReplayCommand.MAX), ready("fast2", ReplayCommand.MAX), ready("slow", 1));
        replays.forEach(this::resume);
        microsPerRecord = 50;

        while (played().size() < EVENTS) {
            assertThat(reader.pollNext(output)).isEqualTo(InputStatus.MORE_AVAILABLE);
        }

        assertThat(played().subList(0, 150)).filteredOn("slow"::equals).hasSize(2);
        assertThat(played().subList(0, 40)).contains("fast1", "fast2");
    }

    @Test
    void measuresLatenessCausedByAnotherReplay() throws Exception {
        missions.with("m1", TIME, TIME + 100);
        missions.with("m2", TIME, TIME + 100);
        List<DesiredReplay> replays = List.of(ready("m1", 1), ready("m2", 1));
        replays.forEach(this::resume);
        while (played().size() < 2) {
            reader.pollNext(output);
        }
        nanos.addAndGet(TimeUnit.MILLISECONDS.toNanos(100));
        microsPerRecord = 3_000_000;

        while (played().size() < 4) {
            reader.pollNext(output);
        }

        assertThat(replays)
                .extracting(replay -> (Long) context.gauge(replay.replay(), "lateness"))
                .anySatisfy(late -> assertThat(late).isGreaterThanOrEqualTo(3_000));
    }

    @Tag("full")
    @Test
    void spreadsStatusReportsOverTime() throws Exception {
        List<DesiredReplay> replays = new ArrayList<>();
        for (int i = 0; i < 20; i++) {
            missions.with("m" + i, TIME, TIME + 100_000);
            replays.add(ready("m" + i, 1));
        }
        replays.forEach(this::resume);
        reader.pollNext(output);
        List<Integer> each = new ArrayList<>();
        for (int tick = 0; tick < 80; tick++) {
            nanos.addAndGet(TimeUnit.MILLISECONDS.toNanos(25));
            records.clear();
            while (reader.pollNext(output) == InputStatus.MORE_AVAILABLE) {
                assertThat(records).hasSizeLessThan(1_000);
            }
            each.add((int) records.stream()
                    .filter(record -> record.topic().equals(Topics.REPLAYS_STATUS))
                    .count());
        }

        assertThat(each.stream().mapToInt(Integer::intValue).sum()).isBetween(60, 110);
        assertThat(each).allSatisfy(count -> assertThat(count).isLessThan(10));
    }
}
