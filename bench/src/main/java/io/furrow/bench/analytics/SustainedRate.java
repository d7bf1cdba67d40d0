package io.furrow.bench.analytics;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.stream.IntStream;

import io.furrow.bench.frame.Chart;
import io.furrow.bench.frame.Figures;

/**
 * The result for a fleet that reported once a second, and the job that reads it.
 *
 * @param sentPerSecond actual rate of the fleet
 * @param foundPerSecond records that the job wrote
 * @param lags least lag of the job's consumer in each second, in records, as of its newest checkpoint
 */
record SustainedRate(Plan plan, double sentPerSecond, double foundPerSecond, List<Long> lags) {
    /** The lag counts as stable if its slope is below this share of the rate. */
    private static final double GROWTH = 0.01;

    /**
     * The load to sustain.
     *
     * @param devices each reports once a second
     * @param side of the square that contains them, meters
     * @param ongoingEvery option of the job
     */
    record Plan(int devices, double side, int parallelism, String ongoingEvery) {}

    /** The minimum between two checkpoints, right after one completes, so that checkpoints do not distort the trend. */
    List<Long> troughs() {
        List<Long> troughs = new ArrayList<>();
        int step = TopicMeasurement.CHECKPOINTS_SECONDS;
        for (int from = 0; from + step <= lags.size(); from += step) {
            troughs.add(Collections.min(lags.subList(from, from + step)));
        }
        return troughs;
    }

    /** Growth of the lag in records per second: the least-squares line through the troughs. */
    double slope() {
        List<Long> troughs = troughs();
        double meanIndex = (troughs.size() - 1) / 2.0;
        double meanLag = troughs.stream().mapToLong(Long::longValue).average().orElse(0);
        double above = 0;
        double below = 0;
        for (int i = 0; i < troughs.size(); i++) {
            above += (i - meanIndex) * (troughs.get(i) - meanLag);
            below += (i - meanIndex) * (i - meanIndex);
        }
        return below == 0 ? Double.NaN : above / below / TopicMeasurement.CHECKPOINTS_SECONDS;
    }

    /** Whether all devices reported and the lag did not grow. */
    boolean isHeld() {
        return sentPerSecond >= (1 - GROWTH) * plan.devices && slope() <= GROWTH * plan.devices;
    }

    void addTo(Figures figures) {
        figures.add(
                "devices", plan.devices,
                "side m", plan.side,
                "sent/s", sentPerSecond,
                "found/s", foundPerSecond,
                "seconds", lags.size(),
                "first trough", troughs().get(0),
                "last trough", troughs().get(troughs().size() - 1),
                "slope/s", slope(),
                "held", isHeld());
    }

    /** Lag over seconds. */
    Chart chart() {
        List<Integer> seconds = IntStream.rangeClosed(1, lags.size()).boxed().toList();
        String title =
                "Lag of the consumer in records, %,d devices at 1 Hz on %,.0f m".formatted(plan.devices, plan.side);
        return new Chart(title, "seconds", "")
                .logarithmic()
                .line("lag", seconds, second -> second, second -> Math.max(1, lags.get(second - 1)))
                .line("a second's", List.of(1, lags.size()), second -> second, second -> plan.devices);
    }
}
