package io.furrow.mission;

import java.util.ArrayDeque;
import java.util.Deque;

/**
 * Finds the event that lies {@code count} matching events before the last one, while events are added in order. Holds
 * {@code count} cursors.
 */
public final class StepBack {
    /** Maximum events of a step back, at 100 bytes each. */
    static final int MAX = 100_000;

    private final Cursor first;
    private final long count;
    private final Deque<Cursor> beforeDesired = new ArrayDeque<>();
    private Cursor last;

    /** @param first the result if there are fewer events */
    StepBack(Cursor first, long count) {
        this.first = first;
        this.count = count;
        this.last = first;
    }

    public static void check(long count) {
        if (count < 1 || count > MAX) {
            throw new IllegalArgumentException("A step back covers 1 to %,d events, not %,d".formatted(MAX, count));
        }
    }

    void add(Cursor event, boolean desired) {
        if (desired) {
            if (beforeDesired.size() == count) {
                beforeDesired.remove();
            }
            beforeDesired.add(last);
            last = event;
        }
    }

    Cursor oldest() {
        return beforeDesired.size() == count ? beforeDesired.element() : first;
    }
}
