package io.furrow.replay.playback;

import java.util.List;
import java.util.Optional;

import org.junit.jupiter.api.Test;

import io.furrow.flink.record.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;

import static org.assertj.core.api.Assertions.assertThat;

/** Tests a playback with slow and failing reads. */
class PlaybackTest {
    private static final StoredEvent FIRST = Missions.event("a", Missions.TIME, "urn:d0");
    private static final StoredEvent NEXT = Missions.event("b", Missions.TIME + 1_000, "urn:d0");

    /** Returns a playback of a recording that continues behind {@link #NEXT}, with its first page read. */
    private static Playback started(DesiredReplay desired, ReadyPage first) {
        Playback playback = new Playback(desired, new PlaybackState(), 0, DesiredStates::wall);
        playback.fetch();
        RecordingExtent extent = new RecordingExtent(FIRST.time(), NEXT.time() + 9_000);
        playback.accept(new ReadResult.Opened(0, Optional.of(extent)), 0);
        playback.fetch();
        playback.accept(new ReadResult.Primed(0, List.of(), first), 0);
        return playback;
    }

    @Test
    void keepsItsPositionUntilTheNextPageIsRead() {
        DesiredReplay desired = DesiredStates.start(ReplayCommand.MAX);
        Playback playback = started(desired, page(FIRST, desired, false));
        assertThat(playback.poll(0)).map(one -> one.event().id()).contains("a");
        playback.fetch();

        assertThat(playback.snapshot(100).position).isEqualTo(FIRST.time());
        DesiredReplay paused = DesiredStates.with(desired, State.PAUSED, 1, null, 0);
        playback.apply(paused, 100);
        playback.apply(DesiredStates.with(paused, State.RUNNING, 1, null, 0), 200);
        playback.accept(new ReadResult.NextPage(0, page(NEXT, desired, true)), 300);

        assertThat(playback.poll(1_199)).as("a second after it was resumed").isEmpty();
        assertThat(playback.poll(1_200)).map(one -> one.event().id()).contains("b");
    }

    /** Otherwise a replay of a device that seldom reports would read hours again after a restart. */
    @Test
    void continuesBehindFilteredEventsAndReportsItsPositionWithoutTheRecording() {
        DesiredReplay desired = DesiredStates.start(1);
        Playback playback = started(desired, page(FIRST, desired, false));
        playback.poll(0);
        playback.fetch();
        assertThat(playback.snapshot(0).cursor).isEqualTo(Cursor.after(FIRST));
        playback.accept(new ReadResult.NextPage(0, page(NEXT, desired, false)), 0);
        playback.fetch();
        playback.accept(new ReadResult.Unavailable(0, "away"), 400);

        assertThat(playback.snapshot(500).cursor).isEqualTo(Cursor.before(NEXT.time()));
        assertThat(playback.status(500, 0, 0).progress().position()).isEqualTo(FIRST.time() + 500);
        assertThat(playback.poll(1_000)).isPresent();
        assertThat(playback.snapshot(1_000).cursor).isEqualTo(Cursor.after(NEXT));
    }

    @Test
    void countsSkippedDocumentsOnceThoughARestartReadsThemAgain() {
        DesiredReplay desired = DesiredStates.start(1);
        Playback playback = started(desired, skipping(page(FIRST, desired, false), 2));
        playback.poll(0);
        playback.fetch();
        playback.accept(new ReadResult.NextPage(0, skipping(page(NEXT, desired, true), 3)), 0);

        Playback restarted = new Playback(desired, playback.snapshot(500), 500, DesiredStates::wall);
        restarted.fetch();
        restarted.accept(new ReadResult.NextPage(0, skipping(page(NEXT, desired, true), 3)), 500);
        assertThat(restarted.poll(2_000)).isPresent();
        assertThat(restarted.status(2_000, 0, 0).progress().skipped()).isEqualTo(5);
    }

    private static ReadyPage skipping(ReadyPage page, long skipped) {
        return new ReadyPage(page.events(), page.read(), page.span(), skipped, page.next(), page.last());
    }

    @Test
    void readsNothingBehindItsEnd() {
        ReplayPlan plan = new ReplayPlan(
                null, null, NEXT.time(), false, List.of("urn:d0"), null, ReplayPlan.Stamps.ORIGINAL, null, List.of());
        DesiredReplay desired = DesiredReplay.started("m", "data.m.replay.0a1b2c3d", plan, ReplayCommand.MAX, 0, 1);
        Playback playback = started(desired, page(Missions.event("c", NEXT.time(), "urn:d1"), desired, false));

        assertThat(playback.poll(0)).map(PlaybackRecord::reason).contains("ended");
        assertThat(playback.fetch()).isEmpty();
    }

    @Test
    void reportsWhatASlowSeekReads() {
        DesiredReplay desired = DesiredStates.with(DesiredStates.start(1), State.PAUSED, 1, NEXT.time(), 0);
        Playback playback = new Playback(desired, new PlaybackState(), 0, DesiredStates::wall);
        playback.fetch();
        assertThat(waiting(playback, 999)).isNull();
        assertThat(waiting(playback, 1_000)).isEqualTo("seeking: opening the recording");

        playback.accept(new ReadResult.Opened(0, Optional.of(new RecordingExtent(FIRST.time(), NEXT.time()))), 1_100);
        playback.fetch();
        assertThat(waiting(playback, 1_200)).isEqualTo("seeking: reading the states before 2023-11-14T22:13:21Z");
        assertThat(playback.isSeeking()).isTrue();

        playback.accept(
                new ReadResult.Primed(0, page(FIRST, desired, false).events(), page(NEXT, desired, true)), 1_300);
        assertThat(waiting(playback, 1_300)).isNull();
        assertThat(playback.isSeeking()).isFalse();
    }

    @Test
    void endsAnEpochThatCannotBeginWithoutSteppingBackInTime() {
        PlaybackState played = new PlaybackState(3, NEXT.time() + 5_000);
        DesiredReplay desired = DesiredStates.with(DesiredStates.start(1), State.RUNNING, 1, NEXT.time(), 0);
        Playback playback = new Playback(desired, played, 0, DesiredStates::wall);
        playback.fetch();

        Optional<PlaybackRecord> end = playback.accept(new ReadResult.Failed(3, "gone"), 0);

        assertThat(end).contains(new PlaybackRecord(PlaybackRecord.Kind.END, null, "gone", 3, 0, NEXT.time(), 5_000));
        assertThat(playback.state()).isEqualTo(State.FAILED);
        assertThat(playback.accept(new ReadResult.Failed(3, "gone"), 0)).isEmpty();
    }

    private static String waiting(Playback playback, long now) {
        return playback.status(now, 0, 0).progress().waiting();
    }

    @Test
    void failsWhenAllEpochsAreUsed() {
        PlaybackState spent = new PlaybackState(Epochs.LAST + 1, 5);

        assertThat(new Playback(DesiredStates.start(1), spent, 0, DesiredStates::wall).status(0, 0, 0))
                .extracting(ReplayStatus::state, ReplayStatus::reason)
                .containsExactly(State.FAILED, "all 262144 epochs are used; start another replay");
    }

    private static ReadyPage page(StoredEvent event, DesiredReplay desired, boolean last) {
        return Missions.ready(new EventPage(List.of(event), List.of(), Cursor.after(event), last), desired, 0);
    }
}
