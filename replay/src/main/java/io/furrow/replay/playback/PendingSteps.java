package io.furrow.replay.playback;

import io.furrow.mission.Cursor;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.replay.playback.PlaybackState.Phase;

/** Computes which requested single steps are pending. */
record PendingSteps(PlaybackState at, DesiredReplay desired) {
    /** Maximum number of events per step back. */
    static final int MAX_BACK = 100_000;

    private boolean isPaused() {
        return desired.desired() == ReplayStatus.State.PAUSED;
    }

    private boolean isOfGroup() {
        return desired.clock() != null;
    }

    private boolean isForwardPending() {
        return desired.step() != null && desired.step().total() > at.steps;
    }

    /** Drops steps that were requested before a seek or while the replay runs. */
    void dropObsolete() {
        DesiredReplay.Step step = desired.step();
        DesiredReplay.Seek seek = desired.seek();
        if (step != null && (!isPaused() || seek != null && seek.sequence() > step.sequence())) {
            at.steps = step.total();
        }
    }

    /** Returns whether a paused replay plays the event. */
    boolean plays(ReadyEvent next) {
        boolean repeats = at.goal != null && next.cursor().compareTo(at.goal) <= 0;
        return isPaused() && !isOfGroup() && (repeats || isForwardPending());
    }

    /** Records that a step has played the event. */
    void played(ReadyEvent next) {
        if (at.goal == null) {
            at.steps++;
        } else if (next.cursor().compareTo(at.goal) >= 0) {
            at.goal = null;
        }
    }

    /**
     * Drops a goal that the replay has passed or cannot reach, and the steps forward at the end.
     *
     * @param next null if it is not read yet, or at the end
     */
    void dropImpossible(ReadyEvent next, boolean isAtEnd) {
        boolean isBehindGoal = at.goal != null && next != null && next.cursor().compareTo(at.goal) > 0;
        if (isBehindGoal || isAtEnd) {
            at.goal = null;
        }
        if (isAtEnd && isForwardPending()) {
            at.steps = desired.step().total();
        }
    }

    /** Returns whether the replay has to step back, also from its end. */
    boolean isBackwardPending() {
        return (at.phase == Phase.PLAYING || at.phase == Phase.ENDED)
                && at.goal == null
                && isPaused()
                && !isOfGroup()
                && desired.step() != null
                && desired.step().total() < at.steps;
    }

    ReadRequest.Back back() {
        return new ReadRequest.Back(at.epoch, at.cursor, beginning(), stepsBack());
    }

    /** Number of events of the next step back. */
    private long stepsBack() {
        return Math.min(at.steps - desired.step().total(), MAX_BACK);
    }

    /** Returns whether this step back is still requested. */
    boolean awaits(ReadResult.SteppedBack steppedBack) {
        return isBackwardPending() && steppedBack.count() <= stepsBack();
    }

    /** Returns whether the recording has that many earlier events. */
    boolean isWithin(ReadResult.SteppedBack steppedBack) {
        return !steppedBack.found().equals(beginning());
    }

    /** Counts these steps back as made. */
    void complete(ReadResult.SteppedBack steppedBack) {
        at.steps = isWithin(steppedBack)
                ? at.steps - steppedBack.count()
                : desired.step().total();
    }

    private Cursor beginning() {
        return Cursor.before(desired.from(at.first));
    }
}
