package io.furrow.control.manager;

/**
 * Sequence numbers that grow with each desired state, over restarts too, so that a host can tell old from new.
 *
 * @param last where the last number is remembered; not shared with others
 */
public record Sequence(Table<Long> last) {
    private static final String LAST = "last";

    public long next() {
        Long before = last.get(LAST);
        long next = before == null ? 1 : before + 1;
        last.put(LAST, next);
        return next;
    }
}
