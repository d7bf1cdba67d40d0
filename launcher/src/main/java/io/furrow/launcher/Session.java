package io.furrow.launcher;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.launcher.status.Status;

/** A suite at the terminal: started, shown, stopped by Ctrl-C within ten seconds. */
final class Session {
    private static final Logger LOG = LoggerFactory.getLogger(Session.class);
    private static final Duration STOP_WITHIN = Duration.ofMillis(9_500);
    private static final int STOPPED_BY_INTERRUPT = 130;

    private final PrintWriter out;
    private final CountDownLatch stopRequested = new CountDownLatch(1);
    private final CountDownLatch stopped = new CountDownLatch(1);

    Session(PrintWriter out) {
        this.out = out;
    }

    /** What runs on top of the suite, for instance simulated devices. */
    interface Guest {
        AutoCloseable join(Suite suite) throws Exception;
    }

    /** Returns when the user asked to stop and everything has stopped. */
    int run(SuiteSettings settings, Guest guest) throws Exception {
        Runtime.getRuntime().addShutdownHook(new Thread(this::stopFromOutside, "stop"));
        out.println("Furrow starts; Ctrl-C stops it.");
        try (Suite suite = Suite.start(settings, new Progress(out));
                AutoCloseable joined = guest.join(suite)) {
            UrlTable.print(out, suite);
            show(suite);
            LOG.info("Stopping, {} included", joined);
        } finally {
            stopped.countDown();
        }
        return 0;
    }

    private void show(Suite suite) throws InterruptedException {
        try (Status status = new Status(
                out,
                System.console() != null && System.getenv("TERM") != null,
                suite.kafka().admin(),
                suite.kafka().clientProperties(),
                suite.flink(),
                suite.jobs())) {
            status.start();
            do {
                status.tick();
            } while (!stopRequested.await(1, TimeUnit.SECONDS));
        }
    }

    /** Runs in the JVM's shutdown: lets {@link #run} stop everything, and ends the JVM if that takes too long. */
    private void stopFromOutside() {
        stopRequested.countDown();
        try {
            if (!stopped.await(STOP_WITHIN.toMillis(), TimeUnit.MILLISECONDS)) {
                out.println("Not everything stopped in time; ending it.");
                out.flush();
                Runtime.getRuntime().halt(STOPPED_BY_INTERRUPT);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
