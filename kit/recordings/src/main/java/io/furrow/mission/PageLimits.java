package io.furrow.mission;

import java.io.Serializable;

/**
 * Limits of a page.
 *
 * @param events at least 1
 * @param bytes stored size, at least 1; the event that exceeds the limit begins the next page, unless it is the first
 */
public record PageLimits(int events, int bytes) implements Serializable {
    public static final PageLimits DEFAULT = new PageLimits(1_000, 4 * 1024 * 1024);

    public PageLimits {
        if (events < 1 || bytes < 1) {
            throw new IllegalArgumentException(
                    "A page needs at least one event and one byte, but the limits are %d and %d"
                            .formatted(events, bytes));
        }
    }
}
