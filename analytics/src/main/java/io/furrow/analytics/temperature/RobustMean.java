package io.furrow.analytics.temperature;

import java.util.Comparator;
import java.util.List;
import java.util.Map;

/**
 * The mean of what devices say, without those that cannot be right: a device is set aside when it is further than 3 × 1.4826
 * × MAD from the median of all devices, where MAD is the median absolute deviation from that median. The factor 1.4826 makes
 * the MAD estimate the standard deviation of normally distributed values (B. Iglewicz, D. Hoaglin, "How to Detect and Handle
 * Outliers", 1993); the cut-off 3 is the conservative one of C. Leys et al., "Detecting outliers: Do not use standard
 * deviation around the mean, use absolute deviation around the median", J. Exp. Soc. Psychol. 49 (2013) 764–766. Half of the
 * devices must be wrong before the result is.
 *
 * <p>A pure function of the votes: their order makes no difference, not even in the last bit. All values are in the unit of
 * the votes; nothing is rounded, since rounding belongs to whoever shows a value.
 *
 * @param mean of the devices that were not set aside
 * @param plainMean of all devices
 * @param spread 1.4826 × MAD of all devices, before the floor: what a standard deviation would be without the defective ones
 * @param devices how many voted, those set aside included
 * @param suspects ids of the devices set aside, sorted
 * @param verified whether there were devices enough (three) to tell a defective one
 */
public record RobustMean(
        double mean, double plainMean, double spread, int devices, List<String> suspects, boolean verified) {
    /** Of no devices there is no mean. */
    static final RobustMean OF_NONE = new RobustMean(Double.NaN, Double.NaN, Double.NaN, 0, List.of(), false);

    private static final double CONSISTENCY = 1.4826;
    private static final double CUT_OFF = 3;
    /** Of two devices that disagree nobody knows which one is right. */
    private static final int FEWEST = 3;

    /**
     * @param votes device id → its value, at least one, all finite
     * @param madFloor the least MAD to judge by. With 0, when most devices agree to the last digit, any other is suspect.
     */
    static RobustMean of(Map<String, Double> votes, double madFloor) {
        double[] values =
                votes.values().stream().mapToDouble(Double::doubleValue).toArray();
        double median = Median.of(values);
        double[] deviations = votes.values().stream()
                .mapToDouble(vote -> Math.abs(vote - median))
                .toArray();
        double mad = Median.of(deviations);
        boolean verified = values.length >= FEWEST;
        double limit = verified ? CUT_OFF * CONSISTENCY * Math.max(mad, madFloor) : Double.POSITIVE_INFINITY;

        return new RobustMean(
                mean(votes, median, limit),
                mean(votes, median, Double.POSITIVE_INFINITY),
                CONSISTENCY * mad,
                values.length,
                votes.keySet().stream()
                        .filter(device -> Math.abs(votes.get(device) - median) > limit)
                        .sorted()
                        .toList(),
                verified);
    }

    /** Sorted before it is summed, because the sum of doubles depends on their order. */
    private static double mean(Map<String, Double> votes, double median, double limit) {
        List<Double> kept = votes.values().stream()
                .filter(vote -> Math.abs(vote - median) <= limit)
                .sorted(Comparator.naturalOrder())
                .toList();
        double sum = 0;
        for (double vote : kept) {
            sum += vote;
        }
        return sum / kept.size();
    }
}
