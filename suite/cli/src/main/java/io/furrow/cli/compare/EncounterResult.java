package io.furrow.cli.compare;

/**
 * Two devices that were close.
 *
 * @param end when it ended, or of an open one the newest time that was emitted
 * @param closest meters
 */
record EncounterResult(ResultSubject subject, long start, long end, boolean isOpen, double closest)
        implements AnalyticsResult {
    /** Both with one more record of the same encounter. */
    EncounterResult and(EncounterResult more) {
        return new EncounterResult(
                subject,
                Math.min(start, more.start),
                isOpen == more.isOpen ? Math.max(end, more.end) : isOpen ? more.end : end,
                isOpen && more.isOpen,
                Math.min(closest, more.closest));
    }

    @Override
    public EncounterResult of(ResultSubject other) {
        return new EncounterResult(other, start, end, isOpen, closest);
    }
}
