package io.furrow.flink.time;

import java.util.function.LongSupplier;

/**
 * How long a replay has been read, over all partitions of its reader: a clock that stands still while the replay is paused.
 * The time between two records counts, of a long one no more than a pause; after the end of an epoch, when nothing more is to
 * come, all of it, unless the next record begins another: then it was the replay that waited, and no partition is behind.
 */
final class ReplayProgress {
    private final LongSupplier clock;
    private final long pauseMillis;
    private long read;
    private long last;
    private boolean ended;
    private boolean begun;
    private long began;
    private long furthest = Long.MIN_VALUE;

    /** @param clock milliseconds since whenever */
    ReplayProgress(LongSupplier clock, long pauseMillis) {
        this.clock = clock;
        this.pauseMillis = pauseMillis;
        last = clock.getAsLong();
    }

    /**
     * A record was read.
     *
     * @param time event time of the record
     * @param reached event time of its partition
     * @param end whether it ends its epoch
     */
    void advance(long time, long reached, boolean end) {
        boolean begins = ended && time > furthest; // after an end that is the last instant of its epoch
        read = begins ? read + Math.min(clock.getAsLong() - last, pauseMillis) : millis();
        last = clock.getAsLong();
        began = begun ? began : last;
        begun = true;
        ended = end;
        furthest = Math.max(furthest, reached);
    }

    /** Milliseconds of reading. */
    long millis() {
        long since = clock.getAsLong() - last;
        return read + (ended ? since : Math.min(since, pauseMillis));
    }

    /** Milliseconds by the clock itself. */
    long clockMillis() {
        return clock.getAsLong();
    }

    /** Milliseconds by the clock itself since a moment of it or since the first record, whichever is later; 0 before that record. */
    long clockMillisSince(long moment) {
        return begun ? clock.getAsLong() - Math.max(moment, began) : 0;
    }

    /** Whether no partition is further. */
    boolean isFurthest(long reached) {
        return reached >= furthest;
    }
}
