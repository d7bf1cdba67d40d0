package io.furrow.analytics.temperature;

import java.util.Comparator;

import io.furrow.analytics.eventtime.Timed;

/**
 * Whether a device was set aside in a field's window, of devices enough to tell.
 *
 * @param device entity id
 * @param value its vote
 * @param mean of those that were not set aside
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 */
public record Verdict(
        String device,
        InputScope scope,
        String field,
        String domain,
        boolean suspect,
        double value,
        double mean,
        long windowStart,
        long windowEnd)
        implements Timed {
    /** By window; of one window suspect ones first, by field. */
    static final Comparator<Verdict> SEQUENCE = Comparator.comparingLong(Verdict::windowEnd)
            .thenComparing(verdict -> !verdict.suspect())
            .thenComparing(Verdict::field);

    /** The device among those of all topics and tenants. */
    public String deviceIdentity() {
        return scope.identity(device);
    }

    /** The window's last instant. */
    @Override
    public long time() {
        return windowEnd - 1;
    }
}
