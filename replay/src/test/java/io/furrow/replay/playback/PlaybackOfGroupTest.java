package io.furrow.replay.playback;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Random;

import org.junit.jupiter.api.Test;

import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus.State;

import static org.assertj.core.api.Assertions.assertThat;

/** Tests replays that follow a group's clock. */
class PlaybackOfGroupTest {
    private static final long T = Missions.TIME;
    private static final List<StoredEvent> LONG =
            List.of(Missions.event("a", T, "urn:d0"), Missions.event("b", T + 1_000, "urn:d0"));
    private static final List<StoredEvent> SHORT = List.of(Missions.event("c", T + 500, "urn:d1"));

    /** Returns a replay of T to T + 2000 that plays T at 2,000 ms of the clock. */
    private static DesiredReplay desired(double speed, boolean loop) {
        ReplayPlan plan =
                new ReplayPlan(null, T, T + 2_000, loop, List.of(), null, ReplayPlan.Stamps.ORIGINAL, null, List.of());
        return DesiredReplay.started("m", "data.m.replay.0a1b2c3d", plan, speed, 0, 1)
                .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(2_000), T));
    }

    private static Playback playback(DesiredReplay desired, long now) {
        return new Playback(desired, new PlaybackState(), now, DesiredStates::wall);
    }

    /** Returns the written records with their times: {@code 2500 b}, {@code 3000 ended}. */
    private static List<String> play(Playback playback, List<StoredEvent> recording, long from, long until) {
        List<String> lines = new ArrayList<>();
        for (long now = from; now <= until && !playback.isOver(); now++) {
            playAt(playback, recording, now, lines);
        }
        return lines;
    }

    private static void playAt(Playback playback, List<StoredEvent> recording, long now, List<String> lines) {
        Optional<PlaybackRecord> played;
        do {
            for (Optional<ReadRequest> fetch = playback.fetch(); fetch.isPresent(); fetch = playback.fetch()) {
                playback.accept(Missions.answer(fetch.get(), recording, playback.desired(), new Random(1)), now);
            }
            played = playback.poll(now);
            played.ifPresent(one -> lines.add(now + " "
                    + (one.event() == null
                            ? one.reason()
                            : one.kind() == PlaybackRecord.Kind.PRIME
                                    ? "prime " + one.event().id()
                                    : one.event().id())));
        } while (played.isPresent());
    }

    @Test
    void keepsTheGapsBetweenMissions() {
        assertThat(play(playback(desired(2, false), 0), LONG, 0, 9_999))
                .containsExactly("2000 a", "2500 b", "3000 ended");
        assertThat(play(playback(desired(2, false), 0), SHORT, 0, 9_999)).containsExactly("2250 c", "3000 ended");
    }

    @Test
    void doesNotWaitForALateMember() {
        assertThat(play(playback(desired(1, false), 2_900), LONG, 2_900, 9_999))
                .containsExactly("2900 a", "3000 b", "4000 ended");
        assertThat(play(playback(desired(1, false), 3_800), LONG, 3_800, 9_999))
                .containsExactly("3800 a", "3800 b", "4000 ended");
    }

    @Test
    void beginsEachPassOfALoopWithTheGroup() {
        List<String> twice = play(playback(desired(1, true), 0), SHORT, 0, 6_000);
        List<String> late = play(playback(desired(1, true), 4_600), SHORT, 4_600, 8_000);

        assertThat(twice).containsExactly("2500 c", "4000 loop", "4500 c", "6000 loop");
        assertThat(late)
                .as("the rest of the second pass")
                .containsExactly("4600 c", "6000 loop", "6500 c", "8000 loop");
    }

    @Test
    void pausesAndResumesWithTheGroup() {
        DesiredReplay desired = desired(1, false);
        Playback playback = playback(desired, 0);
        List<String> lines = play(playback, LONG, 0, 2_300);

        playback.apply(
                desired.desired(State.PAUSED, 2)
                        .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(2_300), T + 300)),
                2_310);
        lines.addAll(play(playback, LONG, 2_311, 5_000));
        assertThat(playback.status(5_000, 0, 0).progress().position()).isEqualTo(T + 300);
        playback.apply(
                desired.desired(State.RUNNING, 3)
                        .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(6_000), T + 300)),
                5_001);
        lines.addAll(play(playback, LONG, 5_001, 9_999));

        assertThat(lines).containsExactly("2000 a", "6700 b", "7700 ended");
    }

    @Test
    void seeksBeforeTheBeginningAndBehindTheEndOfAMission() {
        DesiredReplay desired = desired(1, false);
        Playback playback = playback(desired, 0);
        List<String> lines = play(playback, SHORT, 0, 2_600);

        playback.apply(
                desired.seeking(T, 2).following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(3_000), T)),
                2_601);
        lines.addAll(play(playback, SHORT, 2_602, 3_700));
        playback.apply(
                desired.seeking(T + 1_500, 3)
                        .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(4_000), T + 1_500)),
                3_701);
        lines.addAll(play(playback, SHORT, 3_702, 9_999));

        assertThat(lines).containsExactly("2500 c", "3500 c", "4000 prime c", "4500 ended");
    }

    /** The member begins the next pass before it receives the command. */
    @Test
    void staysInItsPassWhenTheClockWasPausedJustBefore() {
        DesiredReplay desired = desired(1, true);
        Playback playback = playback(desired, 0);
        List<String> lines = play(playback, SHORT, 0, 4_050);

        playback.apply(
                desired.desired(State.PAUSED, 2)
                        .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(3_995), T + 1_995)),
                4_050);
        lines.addAll(play(playback, SHORT, 4_051, 5_099));
        playback.apply(
                desired.desired(State.RUNNING, 3)
                        .following("0a1b2c3d", new DesiredReplay.Clock(DesiredStates.wall(6_000), T + 1_995)),
                5_100);
        lines.addAll(play(playback, SHORT, 5_101, 8_100));

        assertThat(lines).containsExactly("2500 c", "4000 loop", "6505 c", "8005 loop");
    }
}
