package io.furrow.simulators.fleet;

import java.io.IOException;
import java.time.Duration;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.simulators.mqtt.Line;

/**
 * Opens connections in the background, some at a time, and tries again while the MQTT broker is away or refuses: a login may
 * become known to it a moment later.
 */
final class LineOpener implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(LineOpener.class);
    /** Many, because Paho sleeps twice for a tenth of a second in each. */
    private static final int AT_ONCE = 32;

    private static final long IDLE_SECONDS = 10;
    private static final Duration FIRST_PAUSE = Duration.ofMillis(200);
    private static final Duration LONGEST_PAUSE = Duration.ofSeconds(2);
    private static final long CLOSE_SECONDS = 15;

    private final ScheduledThreadPoolExecutor threads = new ScheduledThreadPoolExecutor(AT_ONCE, task -> {
        Thread thread = new Thread(task, "simulated-farm-connects");
        thread.setDaemon(true);
        return thread;
    });

    LineOpener() {
        threads.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        threads.allowCoreThreadTimeOut(true);
    }

    /** What is told of an attempt, on a thread of the opener. */
    interface Outcome {
        void opened(Connections.Way way);

        /** @param attempts so far */
        void failed(Connections.Way way, int attempts, String reason);
    }

    /** Opens it as soon as that can be, unless it is ended before. */
    void open(Connections.Way way, Outcome outcome) {
        threads.execute(() -> attempt(way, outcome, 1, FIRST_PAUSE));
    }

    private void attempt(Connections.Way way, Outcome outcome, int number, Duration pause) {
        if (way.isEnded()) {
            return;
        }
        try {
            way.open();
            outcome.opened(way);
        } catch (IOException | RuntimeException e) { // whatever it is, the device is wanted
            outcome.failed(way, number, e.getMessage());
            Duration longer = pause.multipliedBy(3).dividedBy(2);
            Duration next = longer.compareTo(LONGEST_PAUSE) < 0 ? longer : LONGEST_PAUSE;
            try {
                threads.schedule(
                        () -> attempt(way, outcome, number + 1, next), pause.toMillis(), TimeUnit.MILLISECONDS);
            } catch (RejectedExecutionException closed) {
                LOG.debug("a connection is not tried again because the fleet stops", closed);
            }
        }
    }

    /** Closes a line that nobody uses any more, which takes a moment. */
    void close(Line line) {
        threads.execute(line::close);
    }

    /** Tries no more, and waits for what is under way. */
    @Override
    public void close() {
        threads.shutdownNow();
        try {
            if (!threads.awaitTermination(CLOSE_SECONDS, TimeUnit.SECONDS)) {
                LOG.warn("a connection is still being opened");
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
