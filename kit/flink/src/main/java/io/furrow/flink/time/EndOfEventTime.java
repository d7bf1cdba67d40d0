package io.furrow.flink.time;

/**
 * Detects the end of event time: the watermark at the end of the input, or when a job is stopped with {@code --drain}. That
 * is {@link Long#MAX_VALUE}, or one less from a source with an out-of-orderness.
 */
public final class EndOfEventTime {
    private EndOfEventTime() {}

    /** Whether timers fire because of the end of the input rather than elapsed time. */
    public static boolean isAt(long watermark) {
        return watermark >= Long.MAX_VALUE - 1;
    }
}
