package io.furrow.bench.evaluation;

import java.util.EnumMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;

import org.HdrHistogram.Histogram;

import io.furrow.bench.evaluation.Sweep.Point;
import io.furrow.bench.load.Hop;
import io.furrow.bench.load.LoadReport;
import io.furrow.bench.load.LoadSecond;
import io.furrow.bench.whole.ThreadTimes;

/**
 * What became of one load; a line of the file of results.
 *
 * @param commit of the suite
 * @param sent messages that the MQTT broker acknowledged
 * @param notified records of these messages on {@code data.raw}, copies included
 * @param delivered distinct events at the mission's topic
 * @param duplicated arrivals there of events that had arrived before
 * @param reordered events there that came after one of the same entity that was sent later
 * @param delays by hop, ms
 * @param cores processor time of the suite, sender and reader included, by what threads do
 */
public record PointResult(
        String commit,
        Point point,
        long lasting,
        long sent,
        long notified,
        long delivered,
        long duplicated,
        long reordered,
        Map<Hop, Delay> delays,
        List<LoadSecond> seconds,
        Map<String, Double> cores) {
    private static final Set<String> NO_PARTS = Set.of(ThreadTimes.DEVICES, ThreadTimes.COMPILERS);

    /** Of the messages of one load, ms. */
    public record Delay(double mean, long p50, long p95, long p99, long max) {
        static Delay of(Histogram millis) {
            return new Delay(
                    millis.getTotalCount() == 0 ? 0 : millis.getMean(),
                    millis.getValueAtPercentile(50),
                    millis.getValueAtPercentile(95),
                    millis.getValueAtPercentile(99),
                    millis.getMaxValue());
        }
    }

    static PointResult of(String commit, Point point, LoadReport load, long notified, Map<String, Double> cores) {
        Map<Hop, Delay> delays = new EnumMap<>(Hop.class);
        load.delays().forEach((hop, millis) -> delays.put(hop, Delay.of(millis)));
        return new PointResult(
                commit,
                point,
                load.plan().duration().toSeconds(),
                load.sent(),
                notified,
                load.delivered(),
                load.repeats(),
                load.reordered(),
                delays,
                load.seconds(),
                cores);
    }

    double deliveredRatio() {
        return sent == 0 ? 0 : (double) delivered / sent;
    }

    boolean isWhole() {
        return delivered == sent && duplicated == 0 && reordered == 0;
    }

    Delay endToEnd() {
        return delays.get(Hop.END_TO_END);
    }

    /** The part that took most processor time, but compilers, devices and what stands in for MQTT broker, IoT Agent and context broker. */
    String busiest() {
        return cores.entrySet().stream()
                .filter(part -> !NO_PARTS.contains(part.getKey()))
                .max(Map.Entry.comparingByValue())
                .map(part -> String.format(Locale.ROOT, "%s (%.2f cores)", part.getKey(), part.getValue()))
                .orElse("");
    }
}
