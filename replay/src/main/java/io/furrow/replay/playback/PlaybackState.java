package io.furrow.replay.playback;

import java.io.IOException;

import io.furrow.mission.Cursor;
import io.furrow.model.control.ReplayStatus;

/**
 * Where a replay is; with it a playback continues at the next record.
 *
 * @param sequence of the desired replay that was applied last
 * @param phase what is to be done next
 * @param reason why it is over; null if that needs no reason
 * @param epoch of the next record
 * @param number sequence of the next record in its epoch
 * @param offset ms that timestamps are ahead of event times
 * @param stamp of the newest record; 0 if there is none
 * @param start epoch ms at which the epoch shall begin; null for the replay's beginning
 * @param point epoch ms at which the epoch begins, and from which on its event time counts
 * @param cursor after the last event that was played or left out
 * @param position event time that is reached, epoch ms
 * @param first event time of the recording's first event, epoch ms
 * @param last event time of the recording's last event, epoch ms
 * @param steps single steps that are done or obsolete
 * @param events played in this epoch
 * @param primes played in this epoch
 * @param skipped stored documents of this epoch that hold no event
 * @param goal after the event up to which a step back has to play, though the replay is held; null if none has
 */
public record PlaybackState(
        long sequence,
        Phase phase,
        String reason,
        long epoch,
        long number,
        long offset,
        long stamp,
        Long start,
        long point,
        Cursor cursor,
        long position,
        long first,
        long last,
        long steps,
        long events,
        long primes,
        long skipped,
        Cursor goal) {
    /** What a playback is about. */
    public enum Phase {
        /** Learns what the recording spans. */
        OPENING(0),
        /** Plays what is known before the point. */
        PRIMING(1),
        PLAYING(2),
        /** Waits until the next pass of a loop may begin. */
        BETWEEN(3),
        ENDED(4),
        STOPPED(5),
        FAILED(6);

        private final int code;

        Phase(int code) {
            this.code = code;
        }

        /** By which savepoints name it; never given to another phase. */
        public int code() {
            return code;
        }

        /** @throws IOException if no phase has the code */
        public static Phase of(int code) throws IOException {
            for (Phase phase : values()) {
                if (phase.code == code) {
                    return phase;
                }
            }
            throw new IOException("no phase of a replay has the code " + code);
        }

        public boolean isOver() {
            return this == ENDED || this == STOPPED || this == FAILED;
        }

        /** How a status calls it. */
        ReplayStatus.State told(boolean held) {
            return switch (this) {
                case ENDED -> ReplayStatus.State.ENDED;
                case STOPPED -> ReplayStatus.State.STOPPED;
                case FAILED -> ReplayStatus.State.FAILED;
                default -> held ? ReplayStatus.State.PAUSED : ReplayStatus.State.RUNNING;
            };
        }
    }

    ReplayStatus.Progress progress(long reached, long lateness, long slip, double rate, String waiting) {
        return new ReplayStatus.Progress(
                epoch, reached, first, last, offset, lateness, slip, rate, events, primes, skipped, waiting);
    }

    /** A replay that was never played. */
    public static PlaybackState fresh() {
        return before(0, 0);
    }

    /**
     * A replay of which nothing is known but what is on its topic.
     *
     * @param epoch to begin with
     * @param stamp epoch ms below which its records' timestamps must not be
     */
    public static PlaybackState before(long epoch, long stamp) {
        return new PlaybackState(
                -1, Phase.OPENING, null, epoch, 0, 0, stamp, null, 0, Cursor.START, 0, 0, 0, 0, 0, 0, 0, null);
    }
}
