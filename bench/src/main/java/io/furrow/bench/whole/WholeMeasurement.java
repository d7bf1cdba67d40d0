package io.furrow.bench.whole;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import io.furrow.bench.whole.Part.Figure;

/** Measures one checkout at a time; the machine must be otherwise idle, and the suite's default ports free. */
final class WholeMeasurement {
    /**
     * The results of a measurement.
     *
     * @param roles processor time by thread role, cores; with the switches between threads a second
     */
    record Result(Map<Figure, Double> figures, Map<String, Double> roles, double switchesPerSecond) {
        private static Result of(Map<Figure, Double> figures, ThreadTimes spent, double nanos) {
            Map<String, Double> cores = new LinkedHashMap<>();
            spent.byRole().forEach((role, time) -> cores.put(role, time / nanos));
            return new Result(figures, cores, spent.switches() / nanos * 1e9);
        }
    }

    private static final String END_TO_END = "end_to_end";
    private static final String READY = "Flink web UI";

    private final Duration warmup;
    private final Duration measured;

    WholeMeasurement(Duration warmup, Duration measured) {
        this.warmup = warmup;
        this.measured = measured;
    }

    /** @throws IOException if the suite did not start, or ended early */
    Result run(Checkout checkout, Part part) throws IOException, InterruptedException {
        return switch (part) {
            case IDLE -> running(checkout, "up");
            case DEMO -> running(checkout, "demo");
            case LOAD_125, LOAD_625 -> loaded(checkout, part.devices());
        };
    }

    private Result running(Checkout checkout, String command) throws IOException, InterruptedException {
        long began = System.nanoTime();
        try (SuiteProcess suite = SuiteProcess.start(checkout, List.of(command))) {
            suite.awaitLine(line -> line.contains(READY));
            Map<Figure, Double> figures = new EnumMap<>(Figure.class);
            figures.put(Figure.START_SECONDS, (System.nanoTime() - began) / 1e9);
            suite.discardOutput();
            TimeUnit.NANOSECONDS.sleep(warmup.toNanos());
            Duration before = suite.processorTime();
            ThreadTimes threads = suite.threadTimes();
            long from = System.nanoTime();
            TimeUnit.NANOSECONDS.sleep(measured.toNanos());
            double took = System.nanoTime() - from;
            figures.put(Figure.CORES, suite.processorTime().minus(before).toNanos() / took);
            putSize(suite, figures);
            return Result.of(figures, suite.threadTimes().since(threads), took);
        }
    }

    private Result loaded(Checkout checkout, int devices) throws IOException, InterruptedException {
        Path csv = Files.createTempFile("furrow-whole-", ".csv");
        List<String> arguments = List.of(
                "bench",
                "load",
                "--devices=" + devices,
                "--seconds=" + measured.toSeconds(),
                "--warmup=" + warmup.toSeconds(),
                "--csv=" + csv);
        try (SuiteProcess suite = SuiteProcess.start(checkout, arguments)) {
            String first = " of " + devices * measured.toSeconds() + " sent";
            suite.awaitLine(line -> line.contains(first));
            Duration before = suite.processorTime();
            ThreadTimes threads = suite.threadTimes();
            long from = System.nanoTime();
            suite.awaitLine(line -> line.startsWith("sent "));
            double took = System.nanoTime() - from;
            Duration spent = suite.processorTime().minus(before);
            ThreadTimes byRole = suite.threadTimes().since(threads);
            Map<Figure, Double> figures = new EnumMap<>(Figure.class);
            putSize(suite, figures);
            suite.awaitLine(line -> line.startsWith("end to end"));
            suite.discardOutput();
            String[] row = endToEnd(csv);
            double delivered = Double.parseDouble(row[5]);
            figures.put(Figure.DELIVERED, Double.parseDouble(row[6]));
            figures.put(Figure.CPU_MS_PER_MESSAGE, spent.toNanos() / 1e6 / Math.max(1, delivered));
            figures.put(Figure.P50_MS, Double.parseDouble(row[9]));
            figures.put(Figure.P95_MS, Double.parseDouble(row[10]));
            figures.put(Figure.P99_MS, Double.parseDouble(row[11]));
            return Result.of(figures, byRole, took);
        } finally {
            Files.deleteIfExists(csv);
        }
    }

    private static void putSize(SuiteProcess suite, Map<Figure, Double> figures) throws IOException {
        figures.put(Figure.THREADS, (double) suite.threads());
        figures.put(Figure.RESIDENT_MB, (double) suite.residentMb());
    }

    /** The file is written just after the table is printed. */
    private static String[] endToEnd(Path csv) throws IOException, InterruptedException {
        for (long waited = 0; waited < 100; waited++) {
            for (String line : Files.readAllLines(csv)) {
                String[] row = line.split(",");
                if (row.length == 13 && row[8].equals(END_TO_END)) {
                    return row;
                }
            }
            TimeUnit.MILLISECONDS.sleep(100);
        }
        throw new IOException("the load printed its table but wrote no figures to " + csv);
    }
}
