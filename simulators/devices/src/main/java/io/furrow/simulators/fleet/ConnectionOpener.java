package io.furrow.simulators.fleet;

import java.io.IOException;
import java.time.Duration;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.simulators.mqtt.MqttConnection;

/**
 * Opens connections in the background, several at once, and retries while the MQTT broker is unavailable or refuses: it
 * may learn a login a moment later.
 */
final class ConnectionOpener implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ConnectionOpener.class);
    /** Many, because Paho sleeps twice for a tenth of a second in each. */
    private static final int AT_ONCE = 32;

    private static final long IDLE_SECONDS = 10;
    private static final Duration FIRST_PAUSE = Duration.ofMillis(200);
    private static final Duration MAX_PAUSE = Duration.ofSeconds(2);
    private static final long CLOSE_SECONDS = 15;

    private final ScheduledThreadPoolExecutor threads = new ScheduledThreadPoolExecutor(AT_ONCE, task -> {
        Thread thread = new Thread(task, "simulated-farm-connects");
        thread.setDaemon(true);
        return thread;
    });

    ConnectionOpener() {
        threads.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        threads.allowCoreThreadTimeOut(true);
    }

    /** Receives the outcome of an attempt, on a thread of the opener. */
    interface Outcome {
        void opened(Connections.Channel channel);

        /** @param attempts so far */
        void failed(Connections.Channel channel, int attempts, String reason);
    }

    /** Opens a channel as soon as possible, unless it is ended before. */
    void open(Connections.Channel channel, Outcome outcome) {
        threads.execute(() -> attempt(channel, outcome, 1, FIRST_PAUSE));
    }

    private void attempt(Connections.Channel channel, Outcome outcome, int number, Duration pause) {
        if (channel.isEnded()) {
            return;
        }
        try {
            channel.open();
            outcome.opened(channel);
        } catch (IOException | RuntimeException e) { // retried whatever the cause, because the device is desired
            outcome.failed(channel, number, e.getMessage());
            Duration longer = pause.multipliedBy(3).dividedBy(2);
            Duration next = longer.compareTo(MAX_PAUSE) < 0 ? longer : MAX_PAUSE;
            try {
                threads.schedule(
                        () -> attempt(channel, outcome, number + 1, next), pause.toMillis(), TimeUnit.MILLISECONDS);
            } catch (RejectedExecutionException closed) {
                LOG.debug("a connection is not retried because the fleet stops", closed);
            }
        }
    }

    /** Closes a connection in the background. */
    void close(MqttConnection connection) {
        threads.execute(connection::close);
    }

    /** Stops retries, and waits for attempts in progress. */
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
