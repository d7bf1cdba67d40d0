package io.furrow.mission;

import java.util.ArrayDeque;
import java.util.Deque;

/** Finds the wanted event before the last wanted ones of those that are added in their order. Holds one cursor for each of these. */
public final class StepBack {
    /** More events than anybody steps back, at 100 bytes each. */
    static final int MAX = 100_000;

    private final Cursor first;
    private final long count;
    private final Deque<Cursor> beforeDesired = new ArrayDeque<>();
    private Cursor last;

    /** @param first the answer where fewer events are requested */
    StepBack(Cursor first, long count) {
        this.first = first;
        this.count = count;
        this.last = first;
    }

    public static void check(long count) {
        if (count < 1 || count > MAX) {
            throw new IllegalArgumentException(
                    "Between 1 and %,d events can be gone back, not %,d".formatted(MAX, count));
        }
    }

    /** The next event. */
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
