package io.furrow.bench.control;

import java.time.Duration;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.LongAdder;
import java.util.concurrent.locks.LockSupport;

import org.HdrHistogram.ConcurrentHistogram;
import org.HdrHistogram.Histogram;

import io.furrow.bench.frame.Figures;

/** Sends requests to the managers, numbered consecutively over all loads, and waits for the answer to each. */
final class ControlMeasurement {
    private static final long LAST_ANSWER_SECONDS = 60;

    private final ControlClient client;
    private final String run;
    private long next;

    /** @param run letters and digits that make ids and missions unique to this run */
    ControlMeasurement(ControlClient client, String run) {
        this.client = client;
        this.run = run;
    }

    /**
     * A load of requests.
     *
     * @param rate requests per second, independent of answers; 0 to send the next after each answer
     * @param outstanding maximum number of requests in flight
     */
    record Plan(int rate, int outstanding, Duration duration) {}

    /** Accumulates the results of one load. */
    private static final class Tally {
        final Histogram delays = new ConcurrentHistogram(3);
        final LongAdder answered = new LongAdder();
        final LongAdder unexpected = new LongAdder();
        volatile long lastAnswer;

        void answered(boolean expected, long due) {
            long now = System.nanoTime();
            delays.recordValue(Math.max(0, TimeUnit.NANOSECONDS.toMicros(now - due)));
            answered.increment();
            lastAnswer = now;
            if (!expected) {
                unexpected.increment();
            }
        }
    }

    /** Sends a load and waits for its answers. */
    Report run(Plan plan) throws InterruptedException {
        Tally tally = new Tally();
        Semaphore free = new Semaphore(plan.outstanding());
        long repeatsBefore = client.repeats();
        long begin = System.nanoTime();
        long end = begin + plan.duration().toNanos();
        long sent = 0;
        for (long due = begin; due < end && System.nanoTime() < end; sent++) {
            free.acquire();
            due = plan.rate() == 0 ? System.nanoTime() : begin + sent * TimeUnit.SECONDS.toNanos(1) / plan.rate();
            sleepUntil(due);
            ask(tally, free, due);
        }
        boolean all = free.tryAcquire(plan.outstanding(), LAST_ANSWER_SECONDS, TimeUnit.SECONDS);
        double seconds = ((all ? tally.lastAnswer : System.nanoTime()) - begin) / 1e9;
        return new Report(
                sent,
                tally.answered.sum(),
                tally.unexpected.sum(),
                client.repeats() - repeatsBefore,
                seconds,
                tally.delays);
    }

    private void ask(Tally tally, Semaphore free, long due) {
        long number = next++;
        ControlRequest request = ControlRequest.of(number, run);
        CompletableFuture<String> answer = client.ask(request, run + "-" + number);
        answer.whenComplete((status, failure) -> {
            if (failure == null) {
                tally.answered(request.expected().equals(status), due);
                free.release();
            }
        });
    }

    private static void sleepUntil(long nanos) {
        long left = nanos - System.nanoTime();
        if (left > 0) {
            LockSupport.parkNanos(left);
        }
    }

    /**
     * The results of a load.
     *
     * @param answered requests answered before the final timeout
     * @param unexpected answers whose status differs from that of a manager that runs each request once, in order
     * @param repeats answers to requests that were answered already
     * @param seconds from the first request to the last answer
     * @param delays microseconds from when a request was due to its answer
     */
    record Report(long sent, long answered, long unexpected, long repeats, double seconds, Histogram delays) {
        double perSecond() {
            return answered / seconds;
        }

        boolean isSound() {
            return answered == sent && unexpected == 0 && repeats == 0;
        }

        void addTo(Figures figures, String name) {
            figures.add(
                    "load", name,
                    "sent", sent,
                    "answered", answered,
                    "/s", perSecond(),
                    "p50 ms", delays.getValueAtPercentile(50) / 1000.0,
                    "p99 ms", delays.getValueAtPercentile(99) / 1000.0,
                    "max ms", delays.getMaxValue() / 1000.0,
                    "repeats", repeats,
                    "wrong", unexpected);
        }
    }
}
