package io.furrow.bench.evaluation;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.Base64;
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
 * @param heap of its process at most, MB; 0 of one that is another process
 * @param sent messages that the MQTT broker acknowledged
 * @param notified records of these messages on {@code data.raw}, copies included
 * @param delivered distinct events at the mission's topic
 * @param duplicated arrivals there of events that had arrived before
 * @param reordered events there that came after one of the same entity that was sent later
 * @param delays by hop, ms
 * @param cores processor time of the suite, sender and reader included, by what threads do; empty of one that is another process
 * @param memoryBytes resident memory of its process after the load; 0 of one that is another process
 */
public record PointResult(
        String commit,
        long heap,
        Point point,
        long lasting,
        long sent,
        long notified,
        long delivered,
        long duplicated,
        long reordered,
        Map<Hop, Delay> delays,
        List<LoadSecond> seconds,
        Map<String, Double> cores,
        long memoryBytes) {
    /** Beyond it a point is beyond the knee, ms. */
    static final long MAX_P99 = 1_000;

    /** Of the rate that was to be sent; where the MQTT broker takes less, devices wait, and delays do not show it. */
    private static final double MIN_ATTAINED = 0.95;

    private static final Set<String> NO_PARTS = Set.of(ThreadTimes.DEVICES, ThreadTimes.COMPILERS);

    /**
     * Of the messages of one load, ms.
     *
     * @param histogram all of it, in Base64 what HdrHistogram's {@code decodeFromCompressedByteBuffer} reads
     */
    public record Delay(double mean, long p50, long p95, long p99, long max, String histogram) {
        static Delay of(Histogram millis) {
            ByteBuffer all = ByteBuffer.allocate(millis.getNeededByteBufferCapacity());
            millis.encodeIntoCompressedByteBuffer(all);
            return new Delay(
                    millis.getTotalCount() == 0 ? 0 : millis.getMean(),
                    millis.getValueAtPercentile(50),
                    millis.getValueAtPercentile(95),
                    millis.getValueAtPercentile(99),
                    millis.getMaxValue(),
                    Base64.getEncoder().encodeToString(Arrays.copyOf(all.array(), all.position())));
        }
    }

    static PointResult of(
            EvaluationResults.Run run,
            Point point,
            LoadReport load,
            long notified,
            Map<String, Double> cores,
            long memoryBytes) {
        Map<Hop, Delay> delays = new EnumMap<>(Hop.class);
        load.delays().forEach((hop, millis) -> delays.put(hop, Delay.of(millis)));
        return new PointResult(
                run.commit(),
                run.heap(),
                point,
                load.plan().duration().toSeconds(),
                load.sent(),
                notified,
                load.delivered(),
                load.repeats(),
                load.reordered(),
                delays,
                load.seconds(),
                cores,
                memoryBytes);
    }

    double deliveredRatio() {
        return sent == 0 ? 0 : (double) delivered / sent;
    }

    boolean isWhole() {
        return delivered == sent && duplicated == 0 && reordered == 0;
    }

    /** Whether the suite holds this load: nothing is lost, soon enough, and as much as was to be sent. */
    boolean holds() {
        return delivered == sent && endToEnd().p99() <= MAX_P99 && attained() >= MIN_ATTAINED;
    }

    /** Why it does not. */
    String limit() {
        if (delivered < sent) {
            return String.format(Locale.ROOT, "%.4f delivered", deliveredRatio());
        }
        return endToEnd().p99() > MAX_P99
                ? String.format(Locale.ROOT, "p99 %,d ms", endToEnd().p99())
                : String.format(Locale.ROOT, "%.2f of it could be sent", attained());
    }

    /** The rate at which devices sent, of that of the plan. */
    private double attained() {
        // the first and the last second are only parts of one
        return lasting / Math.max(lasting, (double) lastSecond());
    }

    /** In which something was sent. */
    private long lastSecond() {
        return seconds.stream()
                .filter(second -> second.atDevice() > 0)
                .mapToLong(LoadSecond::second)
                .max()
                .orElse(0);
    }

    /** Messages that came to the reader while devices sent. */
    double arrivedPerSecond() {
        long last = lastSecond();
        double arrived = seconds.stream()
                .filter(second -> second.second() > 0 && second.second() < last)
                .mapToLong(LoadSecond::atReader)
                .sum();
        return arrived / Math.max(1, last - 1);
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
