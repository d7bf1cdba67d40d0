package io.furrow.launcher.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.launcher.process.ClockWatch;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.status.Status;
import io.furrow.launcher.status.StatusScreen;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;

/** A suite at the terminal: started, shown, stopped by Ctrl-C within ten seconds; the JVM ends later if it then archives its classes. */
final class Session {
    private static final Logger LOG = LoggerFactory.getLogger(Session.class);
    private static final Duration STOP_TIMEOUT = Duration.ofMillis(9_500);
    private static final int STOPPED_BY_INTERRUPT = 130;
    /** Set by the script if the JVM archives its classes at exit, last of all. */
    private static final String STORES_CLASSES = "furrow.stores.classes";

    private final PrintWriter out;
    private final ClockWatch clock = new ClockWatch();
    private final UntilStopped shown = new UntilStopped();
    private final CountDownLatch stopped = new CountDownLatch(1);
    private volatile boolean started;
    private volatile StatusScreen screen;

    Session(PrintWriter out) {
        this.out = out;
    }

    /** An addition to the suite, for instance simulated devices. */
    interface Extension {
        AutoCloseable join(Suite suite) throws Exception;
    }

    /**
     * Returns when the user has requested a stop and everything has stopped.
     *
     * @param data folder for data across restarts; null for a temporary directory
     */
    public int run(SuiteSettings settings, Path data, Extension guest) throws Exception {
        out.println("Furrow starts; Ctrl-C stops it.");
        try (RunDirectory directory = RunDirectory.open(data)) {
            Runtime.getRuntime().addShutdownHook(new Thread(() -> stopFromOutside(directory), "stop"));
            directory.leaveToItsOwner();
            try (Suite suite = Suite.start(settings, directory, new Progress(out));
                    AutoCloseable joined = guest.join(suite)) {
                started = true;
                show(suite);
                out.println("Furrow stops …");
                LOG.info("Stopping, {} included", joined);
            }
        } finally {
            stopped.countDown();
        }
        return 0;
    }

    private void show(Suite suite) throws Exception {
        StringWriter addresses = new StringWriter();
        UrlTable.print(new PrintWriter(addresses), suite);
        out.print(addresses);
        out.flush();
        Status.Shown content = new Status.Shown(
                suite.kafka().admin(),
                suite.kafka().clientProperties(),
                suite.flink(),
                suite.jobs(),
                suite::notices,
                addresses.toString().strip().lines().map(String::strip).toList());
        try (StatusScreen drawn = StatusScreen.open();
                Status status = new Status(out, drawn, content)) {
            screen = drawn;
            status.start();
            shown.repeat(() -> {
                clock.check();
                status.tick();
            });
        }
    }

    /**
     * Runs in the JVM's shutdown: lets {@link #run} stop everything. A part that is still starting, or does not stop in time, ends with
     * the JVM; stored files survive that as they survive a power cut.
     */
    private void stopFromOutside(RunDirectory directory) {
        shown.stop();
        StatusScreen drawn = screen;
        if (drawn != null) {
            drawn.close();
        }
        try {
            long timeout = started ? STOP_TIMEOUT.toMillis() : 0;
            if (!stopped.await(timeout, TimeUnit.MILLISECONDS)) {
                directory.close();
                Runtime.getRuntime().halt(STOPPED_BY_INTERRUPT);
            }
            if (Boolean.getBoolean(STORES_CLASSES)) {
                out.println("The JVM stores the suite's classes, once, some 15 s; later starts are quicker.");
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
