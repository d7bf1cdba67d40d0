package io.furrow.bench.load;

import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.Map;

import org.HdrHistogram.Histogram;

import io.furrow.bench.frame.Figures;
import io.furrow.simulators.load.LoadPlan;

/**
 * The result of a load.
 *
 * @param sent messages acknowledged by the MQTT broker
 * @param delivered distinct events at the mission's topic
 * @param repeats repeated arrivals
 * @param reordered events that arrived after a later one of the same entity, by time of sending
 * @param reorderedAfterSource the same by time of receipt at the source
 * @param delays milliseconds, of first arrivals
 * @param seconds the load over time
 */
public record LoadReport(
        LoadPlan plan,
        long sent,
        long delivered,
        long repeats,
        long reordered,
        long reorderedAfterSource,
        Map<Hop, Histogram> delays,
        List<LoadSecond> seconds) {
    private static final double[] PERCENTILES = {50, 95, 99, 100};

    /** Distinct events that arrived, per message sent: 1 is the guarantee. */
    public double deliveredRatio() {
        return sent == 0 ? 0 : (double) delivered / sent;
    }

    public void print(PrintWriter out) {
        double perSecond = plan.devices() * 1000.0 / plan.period().toMillis();
        out.printf(
                Locale.ROOT,
                "%d devices, one message of %d bytes each %d ms (%.0f per second) for %d s%n",
                plan.devices(),
                plan.payloadBytes(),
                plan.period().toMillis(),
                perSecond,
                plan.duration().toSeconds());
        out.printf(
                Locale.ROOT,
                "sent %d   delivered %d   ratio %.4f   repeats %d   reordered %d, after the source %d%n",
                sent,
                delivered,
                deliveredRatio(),
                repeats,
                reordered,
                reorderedAfterSource);
        Figures figures = new Figures("");
        delays.forEach((hop, millis) -> figures.add(
                "delay in ms", hop.title(),
                "p50", millis.getValueAtPercentile(50),
                "p95", millis.getValueAtPercentile(95),
                "p99", millis.getValueAtPercentile(99),
                "max", millis.getMaxValue()));
        figures.print(out);
    }

    /** A header line, then a line per hop. */
    public String csv() {
        StringBuilder csv = new StringBuilder(
                "devices,period_ms,payload_bytes,seconds,sent,delivered,ratio,repeats,hop,p50_ms,p95_ms,p99_ms,max_ms\n");
        for (Hop hop : Hop.values()) {
            csv.append(String.format(
                    Locale.ROOT,
                    "%d,%d,%d,%d,%d,%d,%.6f,%d,%s",
                    plan.devices(),
                    plan.period().toMillis(),
                    plan.payloadBytes(),
                    plan.duration().toSeconds(),
                    sent,
                    delivered,
                    deliveredRatio(),
                    repeats,
                    hop.name().toLowerCase(Locale.ROOT)));
            for (double percent : PERCENTILES) {
                csv.append(',').append(delays.get(hop).getValueAtPercentile(percent));
            }
            csv.append('\n');
        }
        return csv.toString();
    }
}
