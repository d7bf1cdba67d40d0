package io.furrow.control.manager;

/**
 * Generates sequence numbers that increase with each desired state, across restarts, so that hosts can distinguish old
 * from new.
 *
 * @param last stores the last number; not shared with other sequences
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
