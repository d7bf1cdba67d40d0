package io.furrow.bench.replay;

import java.util.Arrays;
import java.util.List;
import java.util.function.ToLongFunction;

import io.furrow.bench.frame.Figures;

/**
 * The lateness of events relative to their schedule.
 *
 * @param p50 ms
 * @param p99 ms
 * @param max ms
 * @param drift median of the last tenth of the events less that of the first, ms
 * @param least ms; negative if an event was early
 */
record Lateness(long p50, long p99, long max, long drift, long least) {
    private static final int TENTH = 10;

    /**
     * An event and its schedule.
     *
     * @param due epoch ms
     * @param happened epoch ms
     */
    record Late(long due, long happened) {
        long millis() {
            return happened - due;
        }
    }

    /** @param events at least one, in scheduled order */
    static Lateness of(List<Late> events) {
        long[] sorted = sorted(events);
        int tenth = Math.max(1, events.size() / TENTH);
        long[] first = sorted(events.subList(0, tenth));
        long[] last = sorted(events.subList(events.size() - tenth, events.size()));
        return new Lateness(
                at(sorted, 0.5),
                at(sorted, 0.99),
                sorted[sorted.length - 1],
                at(last, 0.5) - at(first, 0.5),
                sorted[0]);
    }

    private static long[] sorted(List<Late> events) {
        long[] sorted = events.stream().mapToLong(Late::millis).toArray();
        Arrays.sort(sorted);
        return sorted;
    }

    private static long at(long[] sorted, double share) {
        return sorted[(int) Math.min(sorted.length - 1L, Math.round(share * sorted.length))];
    }

    /** The median of each figure over several measurements; of an even number the upper one. */
    static Lateness median(List<Lateness> all) {
        return new Lateness(
                median(all, Lateness::p50),
                median(all, Lateness::p99),
                median(all, Lateness::max),
                median(all, Lateness::drift),
                median(all, Lateness::least));
    }

    private static long median(List<Lateness> all, ToLongFunction<Lateness> figure) {
        return (long) Figures.median(all, figure::applyAsLong);
    }
}
