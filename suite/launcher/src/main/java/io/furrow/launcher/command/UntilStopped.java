package io.furrow.launcher.command;

import java.time.Duration;
import java.util.concurrent.TimeUnit;

/** Repeats a step until another thread requests a stop, which interrupts a step that waits. */
final class UntilStopped {
    private static final Duration PAUSE = Duration.ofSeconds(1);

    private Thread repeating;
    private boolean isStopped;

    interface Step {
        void run() throws Exception;
    }

    /** Returns once a stop was requested, also if that was before. */
    void repeat(Step step) throws Exception {
        begin();
        try {
            while (!isStopped()) {
                step.run();
                TimeUnit.MILLISECONDS.sleep(PAUSE.toMillis());
            }
        } catch (InterruptedException e) {
            if (!isStopped()) {
                throw e;
            }
        } finally {
            end();
        }
    }

    private synchronized void begin() {
        repeating = Thread.currentThread();
    }

    private synchronized boolean isStopped() {
        return isStopped;
    }

    /** What follows is not interrupted. */
    private synchronized void end() {
        repeating = null;
        if (isStopped) {
            Thread.interrupted();
        }
    }

    synchronized void stop() {
        isStopped = true;
        if (repeating != null) {
            repeating.interrupt();
        }
    }
}
