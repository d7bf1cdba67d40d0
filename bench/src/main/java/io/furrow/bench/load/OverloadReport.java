package io.furrow.bench.load;

import java.io.PrintWriter;
import java.time.Duration;
import java.util.Locale;

import org.HdrHistogram.Histogram;

/**
 * What became of an overload.
 *
 * @param knee at the rate of the plan
 * @param before at half of it
 * @param over at twice of it
 * @param after at half of it again, 5 s after nothing waited any more
 * @param kneeHeap bytes of heap in use after a collection, at the end of {@code knee}; {@code overHeap} likewise
 * @param pending records on the source's disk at the end of {@code over}, as its {@code /health} says
 * @param sent messages that the MQTT broker acknowledged
 * @param delivered distinct events at the mission's topic
 * @param repeats arrivals of events that had arrived before
 */
public record OverloadReport(
        OverloadMeasurement.Plan plan,
        Stage knee,
        Stage before,
        Stage over,
        Stage after,
        Drain drain,
        long kneeHeap,
        long overHeap,
        long pending,
        long sent,
        long delivered,
        long repeats) {
    private static final double MEGABYTE = 1_000_000;

    /**
     * One rate.
     *
     * @param sent messages per second; {@code arrived} likewise
     * @param waiting messages on their way at its end
     * @param delays from device to reader of what was sent in it, ms
     */
    public record Stage(double sent, double arrived, long waiting, Histogram delays) {}

    /**
     * From the end of the overload, while half of the rate was sent.
     *
     * @param first messages on their way at its beginning
     * @param last at its end
     */
    public record Drain(long first, long last, Duration lasting) {
        /** Messages per second by which it shrank; 0 where nothing waited. */
        double rate() {
            return lasting.isZero() ? 0 : (first - last) * 1000.0 / lasting.toMillis();
        }
    }

    public void print(PrintWriter out) {
        out.printf("%-26s %8s %10s %8s %8s %8s%n", "", "sent/s", "arrived/s", "p50 ms", "p99 ms", "waiting");
        print(out, plan.rate() + " a second", knee);
        print(out, "half of it", before);
        print(out, plan.bursts() ? "twice as much, in bursts" : "twice as much", over);
        print(out, "half of it, 5 s after", after);
        out.printf(
                Locale.ROOT,
                "arrived under overload: %.2f of the rate; drained %d messages in %.1f s, %.2f of the rate a second%n",
                over.arrived() / plan.rate(),
                drain.first() - drain.last(),
                drain.lasting().toMillis() / 1000.0,
                drain.rate() / plan.rate());
        out.printf(
                Locale.ROOT,
                "heap after a collection: %.0f MB at the rate, %.0f MB under overload, %.2f; p99 after to before: %.2f%n",
                kneeHeap / MEGABYTE,
                overHeap / MEGABYTE,
                (double) overHeap / kneeHeap,
                (double) p99(after) / Math.max(1, p99(before)));
        out.printf("sent %d   delivered %d   repeats %d%n", sent, delivered, repeats);
        out.printf("/health under overload: %d records on the source's disk that Kafka does not have%n", pending);
        out.flush();
    }

    private static void print(PrintWriter out, String title, Stage stage) {
        out.printf(
                Locale.ROOT,
                "%-26s %8.0f %10.0f %8d %8d %8d%n",
                title,
                stage.sent(),
                stage.arrived(),
                stage.delays().getValueAtPercentile(50),
                p99(stage),
                stage.waiting());
    }

    private static long p99(Stage stage) {
        return stage.delays().getValueAtPercentile(99);
    }
}
