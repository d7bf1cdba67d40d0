package io.furrow.bench.fleet;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.Locale;

/**
 * What was measured.
 *
 * @param untilAllRun from the first wanted device to the last one that runs
 * @param due measures in the time that counted, by the devices' periods
 * @param arrived measures that came
 * @param silent devices of which none came
 * @param delayP50 ms from when a measure was due to its arrival at a subscriber, which holds the broker's work too
 * @param cpu share of one core that the fleet's JVM used
 * @param peakMb most memory that its process had, all of it: heap, code, threads
 */
public record FleetReport(
        FleetPlan plan,
        Duration untilAllRun,
        long due,
        long arrived,
        long silent,
        long delayP50,
        long delayP99,
        double cpu,
        long peakMb) {
    /** Whether all devices reported, and not less than was due but for the edges of the time. */
    public boolean holds() {
        return silent == 0 && arrived >= due * 0.99;
    }

    public void print(PrintWriter out) {
        double seconds = plan.measured().toMillis() / 1000d;
        out.printf(
                Locale.ROOT,
                "%,d devices on %d missions, one measure per %s each, %d MB of heap%n",
                plan.devices(),
                plan.missions(),
                plan.period(),
                plan.heapMb());
        out.printf(Locale.ROOT, "  all run after       %,.1f s%n", untilAllRun.toMillis() / 1000d);
        out.printf(Locale.ROOT, "  measures            %,.0f/s of %,.0f/s due%n", arrived / seconds, due / seconds);
        out.printf(Locale.ROOT, "  silent devices      %,d%n", silent);
        out.printf(Locale.ROOT, "  due to subscriber   p50 %,d ms, p99 %,d ms%n", delayP50, delayP99);
        out.printf(Locale.ROOT, "  processor           %.0f %% of a core%n", 100 * cpu);
        out.printf(Locale.ROOT, "  memory of process   %,d MB at most%n", peakMb);
        out.flush();
    }
}
