package io.furrow.flink;

/**
 * The end of event time: what a watermark says when the input is over, or when a job is stopped with {@code --drain}. The stream
 * of events ends with {@link Long#MAX_VALUE}; a stream beside it that never holds it up says one less from the beginning, so
 * where both meet the smaller of the two is seen first.
 */
public final class EndOfEventTime {
    /** One less than what Flink takes for the end of the stream. */
    static final long BESIDE = Long.MAX_VALUE - 1;

    private EndOfEventTime() {}

    /** Whether timers fire because nothing more comes, and not because time has gone on so far. */
    public static boolean isAt(long watermark) {
        return watermark >= BESIDE;
    }
}
