package io.furrow.bench.analytics;

import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

/** What was measured of collision detection, as a table, as JSON and as a plot. */
public record CollisionReport(List<CollisionRun> runs) {
    private static final String HEAD = "%8s %6s %12s %8s %10s %8s %12s %10s%n";
    private static final String LINE = "%8d %6d %12.0f %8.2f %10.3f %8.0f %12.0f %10s%n";

    public void print(PrintWriter out) {
        out.println("Collisions from memory: 5 m, 2 km x 2 km, random walk of 1 m a second, each device once a second");
        out.printf(HEAD, "devices", "cores", "updates/s", "cpu us", "records", "bytes", "bare loop", "differ");
        for (CollisionRun run : runs) {
            out.printf(
                    Locale.ROOT,
                    LINE,
                    run.plan().devices(),
                    run.plan().parallelism(),
                    run.updatesPerSecond(),
                    run.cpuMicros(),
                    run.recordsPerUpdate(),
                    run.bytesPerDevice(),
                    run.barePerSecond(),
                    run.secondsDifferent() + "/" + run.secondsCompared());
        }
        out.flush();
    }

    /** Whether every second that was compared has as many starts as the bare loop's. */
    public boolean agrees() {
        return runs.stream().allMatch(run -> run.secondsDifferent() == 0 && run.secondsCompared() > 0);
    }

    /** Every figure of every run. */
    public ArrayNode json() {
        ArrayNode json = JsonNodeFactory.instance.arrayNode();
        for (CollisionRun run : runs) {
            json.addObject()
                    .put("devices", run.plan().devices())
                    .put("parallelism", run.plan().parallelism())
                    .put("updatesPerSecond", run.updatesPerSecond())
                    .put("cpuMicrosPerUpdate", run.cpuMicros())
                    .put("recordsPerUpdate", run.recordsPerUpdate())
                    .put("bytesPerDevice", run.bytesPerDevice())
                    .put("bareLoopPerSecond", run.barePerSecond())
                    .put("secondsCompared", run.secondsCompared())
                    .put("secondsDifferent", run.secondsDifferent());
        }
        return json;
    }

    /** Updates per second over the number of devices: a line per parallelism, and the bare loop. */
    public String svg() {
        Plot plot = new Plot("Collision updates per second, from memory", "devices");
        runs.stream()
                .map(run -> run.plan().parallelism())
                .distinct()
                .sorted()
                .forEach(parallelism -> plot.line(
                        parallelism + (parallelism == 1 ? " core" : " cores"),
                        points(run -> run.plan().parallelism() == parallelism, false)));
        plot.line("bare loop, 1 core", points(run -> run.plan().parallelism() == 1, true));
        return plot.svg();
    }

    private List<double[]> points(java.util.function.Predicate<CollisionRun> which, boolean bare) {
        return runs.stream()
                .filter(which)
                .map(run -> new double[] {run.plan().devices(), bare ? run.barePerSecond() : run.updatesPerSecond()})
                .toList();
    }
}
