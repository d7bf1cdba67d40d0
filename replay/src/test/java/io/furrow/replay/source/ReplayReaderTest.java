package io.furrow.replay.source;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.function.BooleanSupplier;
import java.util.stream.LongStream;

import org.apache.flink.api.connector.source.ReaderOutput;
import org.apache.flink.core.io.InputStatus;
import org.apache.flink.runtime.execution.SuppressRestartsException;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.topic.TopicEnd;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class ReplayReaderTest {
    private static final long TIME = 1_700_000_000_000L;

    private final FakeContext context = new FakeContext();
    private final MemoryRecordings missions = new MemoryRecordings();
    private final List<TopicRecord> records = new ArrayList<>();
    private final List<Long> times = new ArrayList<>();
    private final OnePartition topics = new OnePartition();
    private final AtomicLong ahead = new AtomicLong();

    @AutoClose
    private ReplayReader reader = newReader(ReplayClock.SYSTEM);

    private ReplayReader newReader(ReplayClock clock) {
        var fresh = new ReplayReader(context, RecordingSources.of(missions), new PageLimits(2, 1_000), topics, clock);
        fresh.start();
        return fresh;
    }

    static DesiredReplay desired(String mission, double speed, State state, long sequence) {
        return DesiredReplay.started(mission, Topics.replay(mission, "0a1b2c3d"), ReplayPlan.PLAIN, speed, 0, sequence)
                .desired(state, sequence);
    }

    private void start(DesiredReplay desired) {
        reader.addSplits(List.of(new ReplaySplit(desired.replay(), desired.toBytes(), new PlaybackState())));
    }

    private void update(DesiredReplay desired) {
        reader.handleSourceEvents(new ReplayChangeEvent(desired.replay(), desired.toBytes()));
    }

    /**
     * Polls until the mission has that many records of the kind; waits at most a minute for the reader to be available.
     */
    private void play(String mission, String kind, int count) throws Exception {
        playUntil(() -> played(mission, kind).size() >= count);
    }

    private void playUntil(BooleanSupplier done) throws Exception {
        ReaderOutput<TopicRecord> output = new FakeContext.Output(record -> {
            records.add(record);
            times.add(System.nanoTime());
        });
        long until = System.nanoTime() + TimeUnit.MINUTES.toNanos(1);
        while (!done.getAsBoolean()) {
            assertThat(System.nanoTime()).as("%s", records).isLessThan(until);
            if (reader.pollNext(output) == InputStatus.NOTHING_AVAILABLE && !done.getAsBoolean()) {
                reader.isAvailable().get(1, TimeUnit.MINUTES);
            }
        }
    }

    private List<TopicRecord> played(String mission, String kind) {
        return records.stream()
                .filter(record -> record.topic().equals(Topics.replay(mission, "0a1b2c3d")))
                .filter(record -> kind.equals(record.headers().get(HeaderNames.REPLAY_KIND)))
                .toList();
    }

    private ReplayStatus status(String mission) {
        return records.stream()
                .filter(record -> record.topic().equals(Topics.REPLAYS_STATUS))
                .filter(record -> new String(record.key(), UTF_8).equals(mission + ".0a1b2c3d"))
                .reduce((older, newer) -> newer)
                .map(record -> Unchecked.get(() -> ReplayStatus.read(record.value())))
                .orElse(null);
    }

    @Test
    void wakesUpWhenTheNextEventIsDue() throws Exception {
        missions.with("m", TIME, TIME + 200, TIME + 400, TIME + 600);
        long started = System.nanoTime();

        start(desired("m", 1, State.RUNNING, 1));
        play("m", "end", 1);

        List<TopicRecord> events = played("m", "event");
        assertThat(events).extracting(TopicRecord::timestamp).containsExactly(TIME, TIME + 200, TIME + 400, TIME + 600);
        long took = times.get(records.indexOf(events.get(3))) - started;
        assertThat(took).as("never early").isGreaterThan(TimeUnit.MILLISECONDS.toNanos(598));
        assertThat(status("m").state()).isEqualTo(State.ENDED);
        assertThat(status("m").progress().skipped()).isEqualTo(2);
    }

    @Test
    void delaysNoReplayByAnother() throws Exception {
        missions.with("m", TIME, TIME + 50);
        start(desired("stuck", 1, State.RUNNING, 1));
        start(desired("unknown", 1, State.RUNNING, 1));
        reader.addSplits(List.of(new ReplaySplit("bad.0a1b2c3d", "no JSON".getBytes(UTF_8), new PlaybackState())));
        start(desired("m", 1, State.RUNNING, 1));

        playUntil(() -> !played("m", "end").isEmpty()
                && status("unknown") != null
                && status("unknown").state() == State.FAILED);

        assertThat(played("m", "event")).hasSize(2);
        assertThat(status("unknown").reason()).isEqualTo("there is no mission 'unknown'");
        assertThat(played("unknown", "end")).singleElement().satisfies(ReplayReaderTest::isOfEpochZero);
        assertThat(status("bad").state()).isEqualTo(State.FAILED);
        assertThat(status("bad").reason()).contains("cannot be read");
        assertThat(status("stuck").state()).isEqualTo(State.RUNNING);
    }

    @Test
    void reportsThatItWaitsForARecordingAndContinues() throws Exception {
        missions.with("m", TIME, TIME + 1, TIME + 2).setUnavailable("m", true);
        start(desired("m", ReplayCommand.MAX, State.RUNNING, 1));
        playUntil(() -> status("m") != null && status("m").progress().waiting() != null);
        assertThat(status("m").state()).isEqualTo(State.RUNNING);
        assertThat(status("m").progress().waiting()).isEqualTo("the store is unavailable");

        missions.setUnavailable("m", false);
        play("m", "end", 1);

        assertThat(played("m", "event")).hasSize(3);
        assertThat(status("m").progress().waiting()).isNull();
    }

    @Test
    void continuesAfterHalfAMinuteWithoutItsRecordingAndDelaysNoOther() throws Exception {
        reader.close();
        reader = newReader(new ReplayClock(() -> System.nanoTime() + ahead.get()));
        missions.with("m", every100Millis(8)).with("other", every100Millis(400));
        start(desired("m", 1, State.RUNNING, 1));
        start(desired("other", 1, State.RUNNING, 1));
        playUntil(() -> !played("m", "event").isEmpty());

        long began = System.nanoTime();
        missions.setUnavailable("m", true);
        playUntil(() -> status("m").progress().waiting() != null);
        for (int step = 0; step < 300; step++) {
            int others = played("other", "event").size();
            ahead.addAndGet(TimeUnit.MILLISECONDS.toNanos(100));
            playUntil(() -> played("other", "event").size() > others);
        }
        assertThat(status("m").progress().waiting()).isEqualTo("the store is unavailable");
        assertThat(status("m").state()).isEqualTo(State.RUNNING);
        assertThat(played("m", "event")).as("what had been read").hasSizeLessThanOrEqualTo(4);
        assertThat(status("other").progress().slipMillis()).isZero();

        missions.setUnavailable("m", false);
        playUntil(() -> status("m").progress().waiting() == null);
        playUntil(() -> !played("m", "end").isEmpty());
        assertThat(played("m", "event"))
                .extracting(TopicRecord::timestamp)
                .containsExactly(LongStream.of(every100Millis(8)).boxed().toArray(Long[]::new));
        assertThat(status("m").progress().slipMillis())
                .isBetween(29_000L, 31_000L + TimeUnit.NANOSECONDS.toMillis(System.nanoTime() - began));
    }

    private static long[] every100Millis(int count) {
        return LongStream.range(0, count).map(i -> TIME + 100 * i).toArray();
    }

    @Test
    void exposesItsStatusAsMetrics() throws Exception {
        missions.with("m", TIME, TIME + 20);
        start(desired("m", 1, State.RUNNING, 1));

        playUntil(() -> status("m") != null && status("m").state() == State.ENDED);

        assertThat(context.gauge("m.0a1b2c3d", "state")).isEqualTo(State.ENDED.ordinal());
        assertThat(context.gauge("m.0a1b2c3d", "position")).isEqualTo(TIME + 20);
    }

    @Test
    void endsAnEmptyMissionWithAReason() throws Exception {
        missions.with("m");
        start(desired("m", 1, State.RUNNING, 1));

        playUntil(() -> status("m") != null && status("m").state().isOver());

        assertThat(status("m").state()).isEqualTo(State.ENDED);
        assertThat(status("m").reason()).isEqualTo("mission 'm' has no event");
        assertThat(played("m", "end")).singleElement().satisfies(ReplayReaderTest::isOfEpochZero);
    }

    private static void isOfEpochZero(TopicRecord end) {
        assertThat(end.headers())
                .containsAllEntriesOf(Map.of(HeaderNames.REPLAY_EPOCH, "0", HeaderNames.REPLAY_SEQUENCE, "0"));
    }

    @Test
    void reportsTheEndAtOnceAndAsSettledAfterACheckpoint() throws Exception {
        missions.with("m", TIME);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "end", 1);
        assertThat(status("m").state()).isEqualTo(State.ENDED);
        assertThat(status("m").settled()).isFalse();

        reader.snapshotState(4);
        reader.notifyCheckpointComplete(3);
        reader.notifyCheckpointComplete(4);
        playUntil(() -> status("m").settled());

        assertThat(status("m").sequence()).isEqualTo(1);
    }

    @Test
    void playsEventsThatAreRecordedWhileItPlays() throws Exception {
        missions.with("m", TIME, TIME + 10);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "event", 1);

        missions.add("m", TIME + 20);
        play("m", "end", 1);

        assertThat(played("m", "event")).extracting(TopicRecord::timestamp).endsWith(TIME + 20);
    }

    @Test
    void playsAgainFromItsEndInANewEpoch() throws Exception {
        missions.with("m", TIME, TIME + 10, TIME + 20, TIME + 30);
        DesiredReplay running = desired("m", ReplayCommand.MAX, State.RUNNING, 1);
        start(running);
        play("m", "end", 1);
        await().until(() -> missions.open() == 0);
        restart();

        update(running.seeking(TIME + 20, 2));
        play("m", "end", 2);
        assertThat(played("m", "event")).hasSize(6);
        await().until(() -> missions.open() == 0);

        DesiredReplay back = running.desired(State.PAUSED, 3).stepping(-2, 3);
        update(back);
        playUntil(() ->
                status("m").state() == State.PAUSED && status("m").progress().events() == 1);
        assertThat(status("m").progress().epoch()).isEqualTo(2);
        assertThat(status("m").progress().position()).isEqualTo(TIME + 10);
        assertThat(missions.open()).isEqualTo(1);
        update(back.desired(State.RUNNING, 4));
        play("m", "end", 3);
        assertThat(played("m", "event"))
                .extracting(record -> record.headers().get(HeaderNames.REPLAY_EPOCH))
                .containsExactly("0", "0", "0", "0", "1", "1", "2", "2", "2");
        await().until(() -> missions.open() == 0);
    }

    @Test
    void closesItsRecordingWhenAStepBackFromItsEndIsCancelled() throws Exception {
        missions.with("m", TIME, TIME + 10);
        DesiredReplay running = desired("m", ReplayCommand.MAX, State.RUNNING, 1);
        start(running);
        play("m", "end", 1);
        await().until(() -> missions.open() == 0);
        missions.setUnavailable("m", true);
        update(running.desired(State.PAUSED, 2).stepping(-1, 2));
        playUntil(() -> status("m").progress().waiting() != null);
        update(running.desired(State.RUNNING, 3));
        missions.setUnavailable("m", false);

        playUntil(() -> status("m").sequence() == 3 && status("m").progress().waiting() == null);
        await().until(() -> missions.open() == 0);
        assertThat(status("m").state()).isEqualTo(State.ENDED);
        assertThat(played("m", "end")).hasSize(1);
    }

    @Test
    void continuesFromACheckpoint() throws Exception {
        missions.with("m", TIME, TIME + 10, TIME + 20, TIME + 100_000);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "event", 3);

        restart();
        update(desired("m", ReplayCommand.MAX, State.RUNNING, 2));
        play("m", "end", 1);

        assertThat(played("m", "event")).extracting(TopicRecord::timestamp).endsWith(TIME + 20, TIME + 100_000);
        assertThat(played("m", "event"))
                .extracting(record -> record.headers().get(HeaderNames.REPLAY_SEQUENCE))
                .containsExactly("0", "1", "2", "3");
    }

    /** The topic has records from after the checkpoint: two seeks, of which only the later one is still desired. */
    @Test
    void reusesNoEpochOfItsTopic() throws Exception {
        missions.with("m", TIME, TIME + 10, TIME + 100_000);
        DesiredReplay started = desired("m", 1, State.RUNNING, 1);
        start(started);
        play("m", "event", 2);

        topics.end = new TopicEnd(2, TIME + 70_000);
        restart();
        update(started.seeking(TIME + 5, 3));
        play("m", "event", 3);

        assertThat(played("m", "end"))
                .extracting(record -> record.headers().get(HeaderNames.REPLAY_EPOCH))
                .containsExactly("0");
        assertThat(played("m", "event").get(2).headers()).containsEntry(HeaderNames.REPLAY_EPOCH, "3");
        assertThat(played("m", "prime").get(0).timestamp()).isEqualTo(TIME + 70_000);
    }

    @Test
    void continuesBehindTheEndOfItsTopicWithoutACheckpoint() throws Exception {
        missions.with("m", TIME, TIME + 10);
        topics.end = new TopicEnd(6, TIME + 900_000);
        DesiredReplay desired = desired("m", ReplayCommand.MAX, State.RUNNING, 1);
        PlaybackState reported = new PlaybackState(5, TIME + 400_000);
        reader.addSplits(List.of(new ReplaySplit(desired.replay(), desired.toBytes(), reported)));

        play("m", "end", 1);

        assertThat(played("m", "event"))
                .extracting(TopicRecord::timestamp)
                .containsExactly(TIME + 900_000, TIME + 900_010);
        assertThat(played("m", "end").get(0).headers()).containsEntry(HeaderNames.REPLAY_EPOCH, "7");
    }

    @Test
    void beginsANewEpochOnTheTopicOfAnEarlierReplay() throws Exception {
        missions.with("m", TIME, TIME + 10);
        topics.end = new TopicEnd(0, TIME + 10);
        start(desired("m", ReplayCommand.MAX, State.RUNNING, 1));

        play("m", "end", 1);

        assertThat(played("m", "event"))
                .extracting(record -> record.headers().get(HeaderNames.REPLAY_EPOCH))
                .containsExactly("1", "1");
        assertThat(played("m", "event")).extracting(TopicRecord::timestamp).containsExactly(TIME + 10, TIME + 20);
    }

    /** The control plane can then delete the replay. */
    @Test
    void failsAReplayWithAnUnreadableRecord() throws Exception {
        byte[] later = "{\"sequence\": 7, \"replay\": 1}".getBytes(UTF_8);
        reader.addSplits(List.of(new ReplaySplit("bad.0a1b2c3d", later, new PlaybackState())));
        missions.with("m", TIME, TIME + 100_000);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "event", 1);
        reader.handleSourceEvents(new ReplayChangeEvent("m.0a1b2c3d", later));
        play("m", "end", 1);

        reader.snapshotState(1);
        reader.notifyCheckpointComplete(1);
        playUntil(() -> status("m").settled() && status("bad").settled());

        assertThat(List.of(status("m"), status("bad")))
                .allSatisfy(status -> assertThat(status.state()).isEqualTo(State.FAILED))
                .allSatisfy(status -> assertThat(status.sequence()).isEqualTo(7));
    }

    @Test
    void failsOnlyTheReplayWhoseTopicWasDeleted() throws Exception {
        missions.with("m", TIME, TIME + 100_000).with("other", TIME, TIME + 100_000);
        start(desired("m", 1, State.RUNNING, 1));
        start(desired("other", 1, State.RUNNING, 1));
        play("m", "event", 1);
        play("other", "event", 1);

        topics.deleted.add(Topics.replay("m", "0a1b2c3d"));
        play("m", "end", 1);

        playUntil(() -> status("m").state() == State.FAILED);
        assertThat(status("m").reason()).isEqualTo("its topic was deleted while it was played");
        assertThat(status("other").state()).isEqualTo(State.RUNNING);
        assertThat(topics.deleted).isEmpty();
    }

    @Test
    void failsAReplayWhoseTopicCannotBeCreatedAgain() throws Exception {
        missions.with("m", TIME, TIME + 100_000);
        topics.end = new TopicEnd(0, TIME);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "event", 1);

        topics.problem = "no more topics";
        topics.deleted.add(Topics.replay("m", "0a1b2c3d"));

        playUntil(() -> status("m").state() == State.FAILED);
        assertThat(status("m").reason()).isEqualTo("its topic was deleted while it was played");
    }

    @Test
    void failsAReplayWhoseTopicTheBrokerCreatedAgain() throws Exception {
        missions.with("m", TIME, TIME + 100, TIME + 200_000).with("other", TIME, TIME + 200_000);
        start(desired("m", 1, State.RUNNING, 1));
        start(desired("other", 1, State.RUNNING, 1));
        play("m", "event", 1);
        int before = topics.idRequests;
        playUntil(() -> topics.idRequests > before + 1);

        topics.recreated.add(Topics.replay("m", "0a1b2c3d"));
        play("m", "end", 1);

        assertThat(status("m").reason()).isEqualTo("its topic was deleted while it was played");
        assertThat(status("other").state()).isEqualTo(State.RUNNING);
    }

    @Test
    void stopsAReplayWhoseTopicCannotBeCreatedAfterARestart() throws Exception {
        missions.with("m", TIME, TIME + 100_000);
        DesiredReplay running = desired("m", 1, State.RUNNING, 1);
        start(running);
        play("m", "event", 1);

        topics.problem = "no topic may be made";
        restart();
        playUntil(() -> "no topic may be made".equals(status("m").progress().waiting()));
        assertThat(status("m").state()).isEqualTo(State.RUNNING);
        update(running.desired(State.STOPPED, 2));

        playUntil(() -> status("m").state() == State.STOPPED);
        assertThat(played("m", "end")).isEmpty();
    }

    private void restart() throws Exception {
        List<ReplaySplit> splits = new ArrayList<>();
        ReplaySplitSerializer serializer = new ReplaySplitSerializer();
        for (ReplaySplit split : reader.snapshotState(1)) {
            splits.add(serializer.deserialize(serializer.getVersion(), serializer.serialize(split)));
        }
        reader.close();
        reader = newReader(ReplayClock.SYSTEM);
        reader.addSplits(splits);
    }

    @Test
    void stopsWhenACheckpointLeftItBehindItsEnd() throws Exception {
        missions.with("m", TIME, TIME + 10, TIME + 20, TIME + 30);
        DesiredReplay paused = desired("m", 1, State.PAUSED, 1).stepping(3, 1);
        start(paused);
        play("m", "event", 3);
        update(paused.within(new DesiredReplay.Range(TIME, TIME + 15), 2));
        playUntil(() -> status("m").sequence() == 2);

        restart();
        update(paused.desired(State.STOPPED, 3));
        playUntil(() -> status("m").state() == State.STOPPED);

        assertThat(played("m", "end")).hasSize(1);
    }

    @Test
    void removesAnUndesiredReplayAndEndsItsEpoch() throws Exception {
        missions.with("m", TIME, TIME + 100_000);
        start(desired("m", 1, State.RUNNING, 1));
        play("m", "event", 1);

        reader.handleSourceEvents(new ReplayChangeEvent("m.0a1b2c3d", null));
        play("m", "end", 1);

        assertThat(reader.snapshotState(1)).isEmpty();
    }

    private InputStatus lastStatus() throws Exception {
        reader.notifyNoMoreSplits();
        InputStatus status = InputStatus.MORE_AVAILABLE;
        while (status != InputStatus.END_OF_INPUT) {
            reader.isAvailable().get(1, TimeUnit.MINUTES);
            status = reader.pollNext(new FakeContext.Output(records::add));
        }
        return status;
    }

    @Test
    void endsWithItsReplayAfterTheLastSplit() throws Exception {
        missions.with("m", TIME, TIME + 1);
        start(desired("m", ReplayCommand.MAX, State.RUNNING, 1));

        assertThat(lastStatus()).isEqualTo(InputStatus.END_OF_INPUT);

        assertThat(played("m", "end")).hasSize(1);
    }

    @Test
    void failsWithItsReplayAfterTheLastSplit() {
        start(desired("unknown", 1, State.RUNNING, 1));

        assertThatThrownBy(this::lastStatus)
                .isInstanceOf(SuppressRestartsException.class)
                .hasRootCauseMessage("replay unknown.0a1b2c3d failed: there is no mission 'unknown'");
    }
}
