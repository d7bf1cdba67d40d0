package io.furrow.cli.compare;

/**
 * A device that was in a field.
 *
 * @param end when it left; of an open one {@link Long#MAX_VALUE}
 */
record VisitResult(ResultSubject subject, long start, long end, boolean isOpen) implements AnalyticsResult {
    static VisitResult open(ResultSubject subject, long start) {
        return new VisitResult(subject, start, Long.MAX_VALUE, true);
    }

    /** Both with one more record of the same stay. */
    VisitResult and(VisitResult more) {
        return isOpen ? more : this;
    }

    @Override
    public VisitResult of(ResultSubject other) {
        return new VisitResult(other, start, end, isOpen);
    }
}
