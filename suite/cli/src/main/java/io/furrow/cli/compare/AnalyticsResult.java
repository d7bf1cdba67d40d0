package io.furrow.cli.compare;

/** A result that holds for a while, or for a window. Times are original event times, epoch ms. */
sealed interface AnalyticsResult permits EncounterResult, VisitResult, AverageResult {
    /** Its subject: only results with the same subject are compared. */
    ResultSubject subject();

    long start();

    /** The last instant that is known of it. */
    long end();

    /** Whether its end has not been emitted. */
    boolean isOpen();

    /** The same of another subject. */
    AnalyticsResult of(ResultSubject other);
}
