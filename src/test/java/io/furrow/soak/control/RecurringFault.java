package io.furrow.soak.control;

import java.time.Duration;
import java.util.Random;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** Causes a fault repeatedly for random times, on its own thread, and ends it when stopped. */
final class RecurringFault {
    private final String name;
    private final Action action;
    private final Timing timing;
    private final Random random;
    private final CountDownLatch stopped = new CountDownLatch(1);
    private final AtomicInteger count = new AtomicInteger();
    private final Thread thread;
    private volatile boolean active;
    private volatile Exception failure;

    /** Begins and ends the fault. */
    interface Action {
        void begin(Random random) throws Exception;

        void end() throws Exception;
    }

    /**
     * The mean times of a fault.
     *
     * @param times maximum number of repetitions; 0 for no limit
     */
    record Timing(Duration pause, Duration outage, int times) {}

    RecurringFault(String name, Timing timing, Action action, Random random) {
        this.name = name;
        this.action = action;
        this.timing = timing;
        this.random = random;
        this.thread = new Thread(this::run, name);
    }

    void start() {
        thread.setDaemon(true);
        thread.start();
    }

    String name() {
        return name;
    }

    boolean isActive() {
        return active;
    }

    int count() {
        return count.get();
    }

    private void run() {
        try {
            while ((timing.times() == 0 || count.get() < timing.times()) && !awaitStop(timing.pause())) {
                active = true;
                count.incrementAndGet();
                action.begin(random);
                awaitStop(timing.outage());
                action.end();
                active = false;
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (Exception e) { // reported when the fault is stopped
            failure = e;
        }
    }

    /**
     * Waits for a random time between half and one and a half times the mean. @return whether the fault was stopped
     * meanwhile
     */
    private boolean awaitStop(Duration mean) throws InterruptedException {
        long millis = mean.toMillis() / 2 + random.nextLong(mean.toMillis() + 1);
        return stopped.await(millis, TimeUnit.MILLISECONDS);
    }

    /** Returns once the fault has ended. */
    void stop() throws InterruptedException {
        stopped.countDown();
        thread.join();
        if (failure != null) {
            throw new IllegalStateException(name + ": the fault cannot be started or ended", failure);
        }
    }
}
