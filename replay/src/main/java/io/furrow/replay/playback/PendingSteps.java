package io.furrow.replay.playback;

import io.furrow.mission.Cursor;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.replay.playback.PlaybackState.Phase;

/** Which single steps a state of a replay still has to make of those that are requested. */
record PendingSteps(PlaybackState at, DesiredReplay desired) {
    /** Events that are stepped back over at once. */
    static final int MAX_BACK = 100_000;

    private boolean isHeld() {
        return desired.desired() == ReplayStatus.State.PAUSED;
    }

    private boolean isOfGroup() {
        return desired.clock() != null;
    }

    private boolean isForward() {
        return desired.step() != null && desired.step().total() > at.steps;
    }

    /** Those asked for before a jump, or while it runs, are not made up for. */
    void dropObsolete() {
        DesiredReplay.Step step = desired.step();
        DesiredReplay.Seek seek = desired.seek();
        if (step != null && (!isHeld() || seek != null && seek.sequence() > step.sequence())) {
            at.steps = step.total();
        }
    }

    /** Whether a replay that is held plays the event. */
    boolean plays(ReadyEvent next) {
        boolean repeats = at.goal != null && next.cursor().compareTo(at.goal) <= 0;
        return isHeld() && !isOfGroup() && (repeats || isForward());
    }

    /** That event was played by a step. */
    void played(ReadyEvent next) {
        if (at.goal == null) {
            at.steps++;
        } else if (next.cursor().compareTo(at.goal) >= 0) {
            at.goal = null;
        }
    }

    /**
     * Drops a goal that lies behind what is played next or at all, and steps forward at the end.
     *
     * @param next null if it is not known, or at the end
     */
    void dropImpossible(ReadyEvent next, boolean isAtEnd) {
        boolean passed = at.goal != null && next != null && next.cursor().compareTo(at.goal) > 0;
        if (passed || isAtEnd) {
            at.goal = null;
        }
        if (isAtEnd && isForward()) {
            at.steps = desired.step().total();
        }
    }

    /** Whether events before are to be found. Also from its end. */
    boolean wantsBack() {
        return (at.phase == Phase.PLAYING || at.phase == Phase.ENDED)
                && at.goal == null
                && isHeld()
                && !isOfGroup()
                && desired.step() != null
                && desired.step().total() < at.steps;
    }

    ReadRequest.Back back() {
        return new ReadRequest.Back(at.epoch, at.cursor, beginning(), stepsBack());
    }

    /** As many as are found at once. */
    private long stepsBack() {
        return Math.min(at.steps - desired.step().total(), MAX_BACK);
    }

    /** Whether that is still requested. */
    boolean awaits(ReadResult.SteppedBack steppedBack) {
        return wantsBack() && steppedBack.count() <= stepsBack();
    }

    /** Whether there were as many events before. */
    boolean isWithin(ReadResult.SteppedBack steppedBack) {
        return !steppedBack.found().equals(beginning());
    }

    /** Those steps back are made. */
    void done(ReadResult.SteppedBack steppedBack) {
        at.steps = isWithin(steppedBack)
                ? at.steps - steppedBack.count()
                : desired.step().total();
    }

    private Cursor beginning() {
        return Cursor.before(desired.from(at.first));
    }
}
