package io.furrow.soak.control;

import java.time.Duration;
import java.util.Random;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;

/** Something that fails again and again for random times, on a thread of its own, until it is stopped; then it works. */
final class RecurringFault {
    private final String name;
    private final Action action;
    private final Pace pace;
    private final Random random;
    private final CountDownLatch stopped = new CountDownLatch(1);
    private final AtomicInteger count = new AtomicInteger();
    private final Thread thread;
    private volatile boolean active;
    private volatile Exception failure;

    /** Makes it fail, and work again. */
    interface Action {
        void begin(Random random) throws Exception;

        void end() throws Exception;
    }

    /**
     * How often, and for how long.
     *
     * @param times at most; 0 for any number
     */
    record Pace(Duration pause, Duration outage, int times) {}

    RecurringFault(String name, Pace pace, Action action, Random random) {
        this.name = name;
        this.action = action;
        this.pace = pace;
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
            while ((pace.times() == 0 || count.get() < pace.times()) && !isStoppedWithin(pace.pause())) {
                active = true;
                count.incrementAndGet();
                action.begin(random);
                isStoppedWithin(pace.outage());
                action.end();
                active = false;
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (Exception e) { // told when it is stopped
            failure = e;
        }
    }

    /** After a random time, at most half as long again as the mean, at least half as long. */
    private boolean isStoppedWithin(Duration mean) throws InterruptedException {
        long millis = mean.toMillis() / 2 + random.nextLong(mean.toMillis() + 1);
        return stopped.await(millis, TimeUnit.MILLISECONDS);
    }

    /** Returns when it works again. */
    void stop() throws InterruptedException {
        stopped.countDown();
        thread.join();
        if (failure != null) {
            throw new IllegalStateException(name + " could not be made to fail or to work again", failure);
        }
    }
}
