package io.furrow.soak.control;

import java.io.IOException;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.concurrent.locks.LockSupport;

/**
 * Restarts a control plane that has ended by itself, as an orchestrator of containers does: it exits if it is started
 * while Kafka is unavailable. Any other exit is a fault.
 */
final class Supervisor {
    private static final long POLL_NANOS = Duration.ofMillis(500).toNanos();
    private static final Duration MAX_DELAY = Duration.ofSeconds(100);

    private final ControlProcess control;
    private final List<String> faults;
    private final AtomicInteger restarts = new AtomicInteger();
    private volatile boolean desired = true;
    private volatile long kafkaOutageAt;
    private volatile boolean closed;

    Supervisor(ControlProcess control, List<String> faults) {
        this.control = control;
        this.faults = faults;
        Thread thread = new Thread(this::run, "supervisor of " + control.name());
        thread.setDaemon(true);
        thread.start();
    }

    /** How often the control plane exited because Kafka was unavailable. */
    int restarts() {
        return restarts.get();
    }

    /** Notes that Kafka is unavailable, or was until now. */
    void noteKafkaOutage() {
        kafkaOutageAt = System.nanoTime();
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
        boolean explained = kafkaOutageAt != 0 && System.nanoTime() - kafkaOutageAt < MAX_DELAY.toNanos();
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
