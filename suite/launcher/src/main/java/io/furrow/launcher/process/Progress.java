package io.furrow.launcher.process;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.concurrent.Callable;

/** Prints on the terminal which part is starting and how long it took. */
public final class Progress {
    private final PrintWriter out;

    public Progress(PrintWriter out) {
        this.out = out;
    }

    /** Prints a note about a part. */
    public void note(String what) {
        out.println("  " + what);
        out.flush();
    }

    /** Runs one step; steps may run concurrently. */
    public <T> T step(String what, Callable<T> work) throws Exception {
        long start = System.nanoTime();
        out.printf("  starting %s …%n", what);
        out.flush();
        T result = work.call();
        Duration took = Duration.ofNanos(System.nanoTime() - start);
        out.printf("  %-42s ready after %4.1f s%n", what, took.toMillis() / 1000.0);
        out.flush();
        return result;
    }
}
