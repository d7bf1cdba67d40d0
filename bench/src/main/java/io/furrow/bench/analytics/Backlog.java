package io.furrow.bench.analytics;

import java.util.concurrent.ExecutionException;

import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.ProcessStatus;

/**
 * What a job has to catch up with: reports on two partitions, of which the second takes longer to read.
 *
 * @param devices each has reported once a second
 * @param seconds for how long
 * @param padding characters that the records of the second partition have more
 * @param maxDrift option of the job
 */
record Backlog(int devices, int seconds, int padding, String maxDrift) {
    static final int POLL_INTERVAL_SECONDS = 5;
    private static final double MEBIBYTE = 1 << 20;
    private static final int PARTITIONS = 2;

    long records() {
        return (long) devices * seconds;
    }

    /** Event time of the last report, epoch milliseconds. */
    long end() {
        return Fleet.START + 1000L * seconds;
    }

    /** What the job that reads it holds, and how far its partitions are apart. */
    static final class Reading {

        private final Backlog plan;
        private final double before = liveMebibytes();
        private double most;
        private double apart;

        Reading(Backlog plan) {
            this.plan = plan;
        }

        /** One sample, in words. */
        String sample(GroupLag lag) throws InterruptedException, ExecutionException {
            double live = liveMebibytes() - before;
            long first = lag.committed(0);
            long second = lag.committed(1);
            double seconds = (first - second) * (double) PARTITIONS / plan.devices();
            most = Math.max(most, live);
            apart = Math.max(apart, seconds);
            return "%,d and %,d records read, %,.0f s apart, %,.0f MiB held".formatted(first, second, seconds, live);
        }

        void addTo(Figures figures, double seconds, long found) {
            figures.add(
                    "max drift",
                    plan.maxDrift(),
                    "devices",
                    plan.devices(),
                    "seconds of backlog",
                    plan.seconds(),
                    "caught up s",
                    seconds,
                    "records/s",
                    plan.records() / seconds,
                    "apart s",
                    apart,
                    "held MiB",
                    most,
                    "found",
                    found);
        }

        /** Of the heap, after a collection. */
        private static double liveMebibytes() {
            return ProcessStatus.heapAfterCollection() / MEBIBYTE;
        }
    }
}
