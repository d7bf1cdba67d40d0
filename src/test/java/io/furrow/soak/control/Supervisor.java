package io.furrow.soak.control;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;

/**
 * Starts a control plane again that has ended by itself, as a container's orchestrator does: one that is started while Kafka is away
 * ends with a sentence. Any other such end is a fault.
 */
final class Supervisor {
    private static final long POLL_NANOS = Duration.ofMillis(500).toNanos();
    private static final Duration LATE = Duration.ofSeconds(100);

    private final ControlProcess control;
    private final List<String> faults;
    private final AtomicInteger restarts = new AtomicInteger();
    private volatile boolean desired = true;
    private volatile long kafkaWasAway;
    private volatile boolean closed;

    Supervisor(ControlProcess control, List<String> faults) {
        this.control = control;
        this.faults = faults;
        Thread thread = new Thread(this::run, "supervisor of " + control.name());
        thread.setDaemon(true);
        thread.start();
    }

    /** How often it ended because Kafka was away. */
    int restarts() {
        return restarts.get();
    }

    /** Kafka is, or was in this moment, away. */
    void kafkaIsAway() {
        kafkaWasAway = System.nanoTime();
    }

    synchronized void kill() throws InterruptedException {
        desired = false;
        control.kill();
    }

    synchronized void start() throws IOException {
        control.start();
        desired = true;
    }

    void close() {
        closed = true;
    }

    private void run() {
        while (!closed) {
            LockSupport.parkNanos(POLL_NANOS);
            restartIfEnded();
        }
    }

    private synchronized void restartIfEnded() {
        if (closed || !desired || control.isAlive()) {
            return;
        }
        boolean explained = kafkaWasAway != 0 && System.nanoTime() - kafkaWasAway < LATE.toNanos();
        if (!explained) {
            faults.add(control.name() + " ended by itself while Kafka was there; its log is " + control.log());
        }
        try {
            restarts.incrementAndGet();
            control.start();
        } catch (IOException e) {
            faults.add(control.name() + " could not be started: " + e);
        }
    }
}
