package io.furrow.bench.control;

import java.io.PrintWriter;
import java.util.Locale;

import org.HdrHistogram.Histogram;

/**
 * What became of a load.
 *
 * @param answered of those that were sent; the others had no answer long after the last was sent
 * @param unexpected answers of another status than a manager gives that runs each request once, in order
 * @param repeats answers to requests that were answered already
 * @param seconds from the first request to the last answer
 * @param delays microseconds from when a request was due to its answer
 */
public record ControlReport(long sent, long answered, long unexpected, long repeats, double seconds, Histogram delays) {
    public double perSecond() {
        return answered / seconds;
    }

    public boolean isSound() {
        return answered == sent && unexpected == 0 && repeats == 0;
    }

    /** A line per load. */
    public static void header(PrintWriter out) {
        out.printf(
                "%-24s %8s %8s %8s %8s %8s %8s %8s %8s%n",
                "", "sent", "answered", "/s", "p50 ms", "p99 ms", "max ms", "repeats", "wrong");
    }

    public void print(String name, PrintWriter out) {
        out.printf(
                Locale.ROOT,
                "%-24s %8d %8d %8.0f %8.0f %8.0f %8.0f %8d %8d%n",
                name,
                sent,
                answered,
                perSecond(),
                delays.getValueAtPercentile(50) / 1000.0,
                delays.getValueAtPercentile(99) / 1000.0,
                delays.getMaxValue() / 1000.0,
                repeats,
                unexpected);
        out.flush();
    }
}
