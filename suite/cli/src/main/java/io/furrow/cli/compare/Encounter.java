package io.furrow.cli.compare;

/**
 * Two devices that were close.
 *
 * @param end when it ended, or of an open one the newest time that was emitted
 * @param closest meters
 */
record Encounter(Subject subject, long start, long end, boolean isOpen, double closest) implements Span {
    /** Both with one more record of the same encounter. */
    Encounter and(Encounter more) {
        return new Encounter(
                subject,
                Math.min(start, more.start),
                isOpen == more.isOpen ? Math.max(end, more.end) : isOpen ? more.end : end,
                isOpen && more.isOpen,
                Math.min(closest, more.closest));
    }

    @Override
    public Encounter of(Subject other) {
        return new Encounter(other, start, end, isOpen, closest);
    }
}
