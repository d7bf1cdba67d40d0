package io.furrow.analytics.temperature.suspect;

import java.util.Comparator;
import java.util.Objects;

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
 * @param type of the entity; null in state of before types were told apart
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
        long windowEnd,
        String type)
        implements Timed {
    /** By window and type; of one window suspect ones first, by field. */
    static final Comparator<Verdict> SEQUENCE = Comparator.comparingLong(Verdict::windowEnd)
            .thenComparing(Verdict::type, Comparator.nullsFirst(Comparator.naturalOrder()))
            .thenComparing(verdict -> !verdict.suspect())
            .thenComparing(Verdict::field);

    /** The devices of the id among those of all topics and tenants, whatever their types. */
    public String deviceIdentity() {
        return scope.identity(device);
    }

    /** @param other null for none */
    boolean isOfSameWindow(Verdict other) {
        return other != null && windowEnd == other.windowEnd && Objects.equals(type, other.type);
    }

    /** The window's last instant. */
    @Override
    public long time() {
        return windowEnd - 1;
    }
}
