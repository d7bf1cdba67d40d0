package io.furrow.analytics.temperature.suspect;

import java.util.Comparator;

import io.furrow.analytics.eventtime.Timed;
import io.furrow.analytics.temperature.InputScope;

/**
 * Whether a device was excluded from a field's window that had enough devices to decide.
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
