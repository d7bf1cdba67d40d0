package io.furrow.cli.compare;

import java.util.Set;

/** A result that holds for some time, or for a window. Times are original event times, epoch ms. */
sealed interface AnalyticsResult {
    /** Only results of the same subject are compared. */
    ResultSubject subject();

    long start();

    /** Its last known instant. */
    long end();

    /** Whether its end has not been emitted. */
    boolean isOpen();

    /** The same result with another subject. */
    AnalyticsResult of(ResultSubject other);

    /**
     * An encounter of two devices.
     *
     * @param end of the encounter; of an open one the newest emitted time
     * @param closest meters
     */
    record Encounter(ResultSubject subject, long start, long end, boolean isOpen, double closest)
            implements AnalyticsResult {
        /** Merges another record of the same encounter. */
        Encounter and(Encounter more) {
            return new Encounter(
                    subject,
                    Math.min(start, more.start),
                    isOpen == more.isOpen ? Math.max(end, more.end) : isOpen ? more.end : end,
                    isOpen && more.isOpen,
                    Math.min(closest, more.closest));
        }

        @Override
        public Encounter of(ResultSubject other) {
            return new Encounter(other, start, end, isOpen, closest);
        }
    }

    /**
     * A device's stay in a field.
     *
     * @param end of the stay; of an open one {@link Long#MAX_VALUE}
     */
    record Visit(ResultSubject subject, long start, long end, boolean isOpen) implements AnalyticsResult {
        static Visit open(ResultSubject subject, long start) {
            return new Visit(subject, start, Long.MAX_VALUE, true);
        }

        /** Merges another record of the same stay. */
        Visit and(Visit more) {
            return isOpen ? more : this;
        }

        @Override
        public Visit of(ResultSubject other) {
            return new Visit(other, start, end, isOpen);
        }
    }

    /**
     * The average of a field in a window.
     *
     * @param start first instant of the window
     * @param end first instant after the window
     * @param mean NaN without readings
     * @param suspects excluded devices
     * @param quality {@code robust} or {@code unverified}
     */
    record Average(ResultSubject subject, long start, long end, double mean, Set<String> suspects, String quality)
            implements AnalyticsResult {
        public Average {
            suspects = Set.copyOf(suspects);
        }

        @Override
        public boolean isOpen() {
            return false;
        }

        /** Whether it is of a window without readings. */
        boolean isEmpty() {
            return Double.isNaN(mean);
        }

        @Override
        public Average of(ResultSubject other) {
            return new Average(other, start, end, mean, suspects, quality);
        }
    }
}
