package io.furrow.bench.whole;

import java.io.BufferedReader;
import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.function.Predicate;

import io.furrow.bench.frame.ProcessStatus;

/** {@code ./furrow} in its own process, observed from outside: by its output, and by the system's data on it (Linux). */
final class SuiteProcess implements AutoCloseable {
    private static final long STOP_SECONDS = 20;

    private final Process process;
    private final BufferedReader printed;

    private SuiteProcess(Process process) {
        this.process = process;
        this.printed = process.inputReader();
    }

    static SuiteProcess start(Checkout checkout, List<String> arguments) throws IOException {
        List<String> command =
                new ArrayList<>(List.of(checkout.home().resolve("furrow").toString()));
        command.addAll(arguments);
        return new SuiteProcess(new ProcessBuilder(command)
                .directory(checkout.home().toFile())
                .redirectErrorStream(true)
                .start());
    }

    /**
     * Reads on to a line.
     *
     * @throws IOException if the process ends before it prints one; with its last lines
     */
    String awaitLine(Predicate<String> desired) throws IOException {
        List<String> last = new ArrayList<>();
        for (String line = printed.readLine(); line != null; line = printed.readLine()) {
            if (desired.test(line)) {
                return line;
            }
            last.add(line);
        }
        throw new IOException("the suite ended early: "
                + String.join("\n", last.subList(Math.max(0, last.size() - 5), last.size())));
    }

    /** Reads on in the background, so that the process never blocks on output. */
    void discardOutput() {
        Thread reader = new Thread(
                () -> {
                    try {
                        awaitLine(line -> false);
                    } catch (IOException e) {
                        // It ended.
                    }
                },
                "suite-output");
        reader.setDaemon(true);
        reader.start();
    }

    /** Processor time so far. */
    Duration processorTime() throws IOException {
        return process.info().totalCpuDuration().orElseThrow(() -> new IOException("the suite has ended"));
    }

    ThreadTimes threadTimes() throws IOException {
        return ThreadTimes.of(process.pid());
    }

    long threads() throws IOException {
        return ProcessStatus.of(process.pid(), "Threads");
    }

    long residentMb() throws IOException {
        return ProcessStatus.of(process.pid(), "VmRSS") / 1024;
    }

    @Override
    public void close() {
        process.destroy();
        try {
            if (process.waitFor(STOP_SECONDS, TimeUnit.SECONDS)) {
                return;
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        process.destroyForcibly();
    }
}
