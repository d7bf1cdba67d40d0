package io.furrow.flink.time;

/**
 * The end of event time: what a watermark says when the input is over, or when a job is stopped with {@code --drain}. That is
 * {@link Long#MAX_VALUE}, or one less where a source with an out-of-orderness says it.
 */
public final class EndOfEventTime {
    private EndOfEventTime() {}

    /** Whether timers fire because nothing more comes, and not because time has gone on so far. */
    public static boolean isAt(long watermark) {
        return watermark >= Long.MAX_VALUE - 1;
    }
}
