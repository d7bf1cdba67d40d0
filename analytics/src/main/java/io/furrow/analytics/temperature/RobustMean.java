package io.furrow.analytics.temperature;

import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;

/**
 * The mean of the devices' votes, without those that the {@link SuspectRule} excludes.
 *
 * <p>A pure function of the votes: their order makes no difference, not even in the last bit. All values are in the unit of
 * the votes and not rounded; rounding is left to the display.
 *
 * @param mean of the devices that were not excluded
 * @param plainMean of all devices
 * @param spread 1.4826 × the median absolute deviation of all devices from their median: an estimate of the standard
 *     deviation without the defective ones (B. Iglewicz, D. Hoaglin, "How to Detect and Handle Outliers", 1993)
 * @param devices number of devices that voted, including excluded ones
 * @param suspects ids of the excluded devices, sorted
 * @param verified whether there were enough devices (three) to detect a defective one
 */
public record RobustMean(
        double mean, double plainMean, double spread, int devices, List<String> suspects, boolean verified) {
    /** The result without devices. */
    static final RobustMean OF_NONE = new RobustMean(Double.NaN, Double.NaN, Double.NaN, 0, List.of(), false);

    private static final double CONSISTENCY = 1.4826;

    /**
     * @param votes device → its value, at least one, all finite
     * @param floor by how much two sound devices in one place differ; with 0, when most devices agree to the last digit, any
     *     other is suspect
     */
    static RobustMean of(Map<String, Double> votes, double floor) {
        double median = Median.of(
                votes.values().stream().mapToDouble(Double::doubleValue).toArray());
        List<Map.Entry<String, Double>> outward =
                votes.entrySet().stream().sorted(nearestFirst(median)).toList();
        double[] values = outward.stream().mapToDouble(Map.Entry::getValue).toArray();
        double[] differences =
                Arrays.stream(values).map(value -> value - median).toArray();
        int sound = SuspectRule.sound(differences, floor);

        return new RobustMean(
                mean(values, sound),
                mean(values, values.length),
                CONSISTENCY
                        * Median.of(Arrays.stream(differences).map(Math::abs).toArray()),
                values.length,
                outward.stream().skip(sound).map(Map.Entry::getKey).sorted().toList(),
                values.length >= SuspectRule.MIN);
    }

    /** The same with other names of the suspects. */
    RobustMean naming(List<String> names) {
        return new RobustMean(mean, plainMean, spread, devices, names, verified);
    }

    /** Equal votes are neighbors: the rule does not depend on which device gave which. */
    private static Comparator<Map.Entry<String, Double>> nearestFirst(double median) {
        return Comparator.comparingDouble((Map.Entry<String, Double> vote) -> Math.abs(vote.getValue() - median))
                .thenComparingDouble(Map.Entry::getValue);
    }

    /** The sum of doubles depends on their order, which is the same for the same votes. */
    private static double mean(double[] outward, int count) {
        double sum = 0;
        for (int i = 0; i < count; i++) {
            sum += outward[i];
        }
        return sum / count;
    }
}
