package io.furrow.flink.time;

import java.util.function.LongSupplier;

/**
 * Measures how long a replay has been read, over all partitions of its reader: a clock that stands still while the replay is paused.
 * The time between two records counts, up to the length of a pause; after the end of an epoch all of it counts, unless the next
 * record begins another epoch: then the replay waited, and no partition is behind.
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

    /** @param clock milliseconds from any origin */
    ReplayProgress(LongSupplier clock, long pauseMillis) {
        this.clock = clock;
        this.pauseMillis = pauseMillis;
        last = clock.getAsLong();
    }

    /**
     * Called for each record.
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

    /** Milliseconds of the underlying clock. */
    long clockMillis() {
        return clock.getAsLong();
    }

    /** Milliseconds of the underlying clock since a moment or since the first record, whichever is later; 0 before that record. */
    long clockMillisSince(long moment) {
        return begun ? clock.getAsLong() - Math.max(moment, began) : 0;
    }

    /** Whether no partition is further. */
    boolean isFurthest(long reached) {
        return reached >= furthest;
    }
}
