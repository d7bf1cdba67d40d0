package io.furrow.control.manager;

/** Sequence numbers that grow with each desired state, over restarts too, so that a host can tell old from new. */
public final class Sequence {
    private static final String LAST = "last";

    private final Table<Long> last;

    /** @param last where the last number is remembered; not shared with others */
    public Sequence(Table<Long> last) {
        this.last = last;
    }

    public long next() {
        Long before = last.get(LAST);
        long next = before == null ? 1 : before + 1;
        last.put(LAST, next);
        return next;
    }
}
