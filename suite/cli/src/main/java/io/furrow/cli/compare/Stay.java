package io.furrow.cli.compare;

/**
 * A device that was in a field.
 *
 * @param end when it left; of an open one {@link Long#MAX_VALUE}
 */
record Stay(Subject subject, long start, long end, boolean isOpen) implements Span {
    static Stay open(Subject subject, long start) {
        return new Stay(subject, start, Long.MAX_VALUE, true);
    }

    /** Both with one more record of the same stay. */
    Stay and(Stay more) {
        return isOpen ? more : this;
    }

    @Override
    public Stay of(Subject other) {
        return new Stay(other, start, end, isOpen);
    }
}
