package io.furrow.mission;

import java.io.Serializable;

/**
 * How much a page holds at most.
 *
 * @param events at least 1
 * @param bytes as stored, at least 1; the event that passes the limit begins the next page, unless it is the first
 */
public record PageLimits(int events, int bytes) implements Serializable {
    public static final PageLimits DEFAULT = new PageLimits(1_000, 4 * 1024 * 1024);

    public PageLimits {
        if (events < 1 || bytes < 1) {
            throw new IllegalArgumentException(
                    "A page holds at least one event and one byte, not %d and %d".formatted(events, bytes));
        }
    }
}
