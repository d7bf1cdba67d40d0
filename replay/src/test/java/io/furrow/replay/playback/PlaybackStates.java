package io.furrow.replay.playback;

import io.furrow.mission.Cursor;

/** Creates states with different values in all members. */
public final class PlaybackStates {
    private PlaybackStates() {}

    public static PlaybackState of(PlaybackState.Phase phase, String reason, Long start, Cursor goal) {
        PlaybackState state = new PlaybackState(2, 5);
        state.sequence = 1;
        state.phase = phase;
        state.reason = reason;
        state.number = 3;
        state.offset = 4;
        state.start = start;
        state.point = 6;
        state.cursor = new Cursor(7, "ñ");
        state.position = 8;
        state.first = 9;
        state.last = 10;
        state.steps = 11;
        state.events = 12;
        state.primes = 13;
        state.skipped = 14;
        state.goal = goal;
        return state;
    }
}
