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
 * The result of one load; a line of the file of results.
 *
 * @param commit of the suite
 * @param heap maximum of its process, MB; 0 for another process
 * @param sent messages acknowledged by the MQTT broker
 * @param notified records of these messages on {@code data.raw}, copies included
 * @param delivered distinct events at the mission's topic
 * @param duplicated repeated arrivals there
 * @param reordered events there that arrived after a later one of the same entity
 * @param delays by hop, ms
 * @param cores processor time of the suite, sender and reader included, by thread role; empty for another process
 * @param memoryBytes resident memory of its process after the load; 0 for another process
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
    /** The greatest p99 of a load that holds, ms. */
    static final long MAX_P99 = 1_000;

    /** The least share of the desired rate: if the MQTT broker accepts less, devices wait, which delays do not show. */
    private static final double MIN_ATTAINED = 0.95;

    private static final Set<String> NO_PARTS = Set.of(ThreadTimes.DEVICES, ThreadTimes.COMPILERS);

    /**
     * The delays of the messages of one load, ms.
     *
     * @param histogram in Base64, for HdrHistogram's {@code decodeFromCompressedByteBuffer}
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

    /** Whether the suite holds this load: no loss, a low delay, and the desired rate. */
    boolean holds() {
        return delivered == sent && endToEnd().p99() <= MAX_P99 && attained() >= MIN_ATTAINED;
    }

    /** The reason why it does not hold. */
    String limit() {
        if (delivered < sent) {
            return String.format(Locale.ROOT, "%.4f delivered", deliveredRatio());
        }
        return endToEnd().p99() > MAX_P99
                ? String.format(Locale.ROOT, "p99 %,d ms", endToEnd().p99())
                : String.format(Locale.ROOT, "%.2f of it could be sent", attained());
    }

    /** The actual rate of devices divided by the planned one. */
    private double attained() {
        // the first and the last second are incomplete
        return lasting / Math.max(lasting, (double) lastSecond());
    }

    /** The last second in which a message was sent. */
    private long lastSecond() {
        return seconds.stream()
                .filter(second -> second.atDevice() > 0)
                .mapToLong(LoadSecond::second)
                .max()
                .orElse(0);
    }

    /** Arrivals at the reader while devices sent. */
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

    /** The part with the most processor time, except compilers, devices and stand-ins for MQTT broker, IoT Agent and context broker. */
    String busiest() {
        return cores.entrySet().stream()
                .filter(part -> !NO_PARTS.contains(part.getKey()))
                .max(Map.Entry.comparingByValue())
                .map(part -> String.format(Locale.ROOT, "%s (%.2f cores)", part.getKey(), part.getValue()))
                .orElse("");
    }
}
