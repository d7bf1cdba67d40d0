package io.furrow.bench.analytics;

import java.util.concurrent.ExecutionException;

import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.ProcessStatus;

/**
 * A backlog for a job: reports on two partitions, of which the second takes longer to read.
 *
 * @param devices each has reported once a second
 * @param seconds its length
 * @param padding additional characters in records of the second partition
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

    /** Samples the memory of the job that reads it, and the drift between its partitions. */
    static final class Reading {

        private final Backlog plan;
        private final double before = liveMebibytes();
        private double most;
        private double apart;

        Reading(Backlog plan) {
            this.plan = plan;
        }

        /** One sample as a sentence. */
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

        /** Heap in use after a collection. */
        private static double liveMebibytes() {
            return ProcessStatus.heapAfterCollection() / MEBIBYTE;
        }
    }
}
