package io.furrow.kafka;

import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

import org.apache.kafka.common.errors.InterruptException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.text.FailureText;
import io.furrow.model.time.Backoff;

/**
 * A thread that works until it is closed. Exceptions are logged and part of its status; the work then restarts after a backoff of
 * one to thirty seconds. An {@link Error} ends it, visibly.
 */
public final class SupervisedWorker implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(SupervisedWorker.class);
    private static final Duration MIN_BACKOFF = Duration.ofSeconds(1);
    private static final Duration MAX_BACKOFF = Duration.ofSeconds(30);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(10);

    private final String name;
    private final Clock clock;
    private final CountDownLatch closing = new CountDownLatch(1);
    private Thread thread;
    private Supplier<String> detail;
    private volatile Instant lastSuccess;
    private volatile String lastFailure;

    /** The work of the thread. */
    public interface Work {
        /** Returns when the worker is closed; called again after it threw. */
        void run(SupervisedWorker worker) throws InterruptedException;
    }

    public SupervisedWorker(String name, Clock clock) {
        this.name = name;
        this.clock = clock;
    }

    /**
     * Must be called once.
     *
     * @param waiting describes what it waits for, for the status; called by any thread
     */
    public SupervisedWorker start(Work work, Supplier<String> waiting) {
        detail = waiting;
        thread = new Thread(() -> run(work), "furrow-" + name);
        thread.setDaemon(true);
        thread.start();
        return this;
    }

    public boolean isClosing() {
        return closing.getCount() == 0;
    }

    /** Waits for its next turn; returns early when closed. */
    public void pause(Duration time) throws InterruptedException {
        closing.await(time.toMillis(), TimeUnit.MILLISECONDS);
    }

    /** Records a success. */
    public void succeeded() {
        lastSuccess = clock.instant();
    }

    /** Records a failure that does not end its work. */
    public void failed(String reason) {
        lastFailure = "last failure at %s: %s".formatted(clock.instant(), reason);
    }

    public ComponentStatus status() {
        String waiting = detail.get();
        String failure = lastFailure;
        ComponentStatus.State state = thread.isAlive() ? ComponentStatus.State.UP : ComponentStatus.State.DEAD;
        return new ComponentStatus(name, state, lastSuccess, failure == null ? waiting : waiting + "; " + failure);
    }

    private void run(Work work) {
        try {
            Backoff backoff = new Backoff(MIN_BACKOFF, MAX_BACKOFF);
            while (!isClosing()) {
                Instant begun = clock.instant();
                if (!runOnce(work)) {
                    if (Duration.between(begun, clock.instant()).compareTo(MAX_BACKOFF) > 0) {
                        backoff.reset();
                    }
                    pause(backoff.next());
                }
            }
        } catch (InterruptedException e) { // as close() asks
            LOG.debug("{} ends", name, e);
        } catch (Error e) {
            failed(FailureText.of(e) + "; it has ended, start the process again");
            LOG.error("{} has ended; start the process again", name, e);
            throw e;
        }
    }

    /** Returns whether it ended without failing. */
    private boolean runOnce(Work work) throws InterruptedException {
        try {
            work.run(this);
            return true;
        } catch (InterruptException e) { // Kafka's, which is a RuntimeException
            throw new InterruptedException(e.getMessage());
        } catch (RuntimeException e) { // no exception may end a thread that nothing restarts
            LOG.error("{} failed and restarts", name, e);
            failed(FailureText.of(e));
            return false;
        }
    }

    /** Ends the work; interrupts it if it does not end in time. */
    @Override
    public void close() {
        closing.countDown();
        try {
            thread.join(CLOSE_TIMEOUT.toMillis());
            if (thread.isAlive()) {
                thread.interrupt();
                thread.join(CLOSE_TIMEOUT.toMillis());
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
