package io.furrow.replay.playback;

/**
 * A record of a replay.
 *
 * @param event null for an end
 * @param reason of an end; else null
 * @param sequence from 0 in each epoch
 * @param time event time, epoch ms; for a prime the point at which the epoch begins
 * @param offset ms that the record's timestamp is ahead of the time
 */
public record PlaybackRecord(
        Kind kind, ReadyEvent event, String reason, long epoch, long sequence, long time, long offset) {
    /** The kind of a record, as in its header {@code replay-kind}. */
    public enum Kind {
        EVENT,
        PRIME,
        END
    }

    /** Returns the record's timestamp, epoch ms. */
    public long stamp() {
        return time + offset;
    }
}
