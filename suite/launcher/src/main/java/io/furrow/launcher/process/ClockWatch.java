package io.furrow.launcher.process;

import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.LongSupplier;

import io.furrow.cli.option.CommandException;

/**
 * Ends a process whose wall clock is set back. Kafka's brokers and clients, Connect and Kafka Streams schedule by the wall clock:
 * heartbeats, commits and punctuations would stand still until the clock is again where it was. A new process begins at the
 * right time.
 */
public final class ClockWatch {
    /** Standing still for less than this does no harm. */
    static final Duration MAX_STEP = Duration.ofSeconds(10);

    private final LongSupplier wallMillis;
    private final LongSupplier nanos;
    private long offset;

    public ClockWatch() {
        this(System::currentTimeMillis, System::nanoTime);
    }

    ClockWatch(LongSupplier wallMillis, LongSupplier nanos) {
        this.wallMillis = wallMillis;
        this.nanos = nanos;
        this.offset = offset();
    }

    private long offset() {
        return wallMillis.getAsLong() - TimeUnit.NANOSECONDS.toMillis(nanos.getAsLong());
    }

    /** @throws CommandException if the clock was set back since the last check */
    public void check() {
        long before = offset;
        offset = offset();
        long step = before - offset;
        if (step > MAX_STEP.toMillis()) {
            throw new CommandException(
                    ("The clock was set back by %d s, so Kafka would wait for as long. Start again, as systemd and Docker do by "
                                    + "themselves, and let the clock be synchronized before the start.")
                            .formatted(step / 1000));
        }
    }

    /** Watches in the background, and exits with 1, for a command that waits by itself. */
    public static void endProcess() {
        ClockWatch clock = new ClockWatch();
        Thread thread = new Thread(
                () -> {
                    try {
                        clock.await(new CountDownLatch(1));
                    } catch (CommandException e) {
                        System.err.println(e.getMessage());
                        System.exit(1);
                    } catch (InterruptedException e) {
                        Thread.currentThread().interrupt();
                    }
                },
                "clock-watch");
        thread.setDaemon(true);
        thread.start();
    }

    /** Waits until the process is to stop. */
    public void await(CountDownLatch stop) throws InterruptedException {
        while (!stop.await(1, TimeUnit.SECONDS)) {
            check();
        }
    }
}
