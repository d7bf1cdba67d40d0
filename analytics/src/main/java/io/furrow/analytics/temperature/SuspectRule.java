package io.furrow.analytics.temperature;

/**
 * Separates sound votes from those that are too far out, from the middle outward: the majority nearest to the median is sound;
 * each further vote is compared with all nearer ones, and the first that is too far from their mean is set aside with all votes
 * further out. Up to half of the devices, less one, may be wrong. This is the procedure of A. Hadi and J. Simonoff, "Procedures
 * for the identification of multiple outliers in linear models", J. Am. Stat. Assoc. 88 (1993) 1264–1272, for one variable.
 *
 * <p>Of n votes, the one that follows the k nearest is too far from their mean when it is further than
 *
 * <pre>√(2 ln 22n) × √(1 + 1/k) × max(floor / √2, (n − 1)/k × s)</pre>
 *
 * s being their standard deviation. The first factor is within 0.06 of the normal quantile that the greatest of n sound votes
 * exceeds in 1 % of windows, from 3 to 1,000 devices; the second allows for the error of the mean of k. The factor of s allows
 * for the k nearest of n − 1 being closer together than all of them: by k/(n − 1) if they are spread evenly. {@code
 * SuspectSimulationTest} measures how often sound and defective devices become suspects.
 */
final class SuspectRule {
    /** If two devices disagree, it cannot be decided which one is right. */
    static final int MIN = 3;

    private static final double SAMPLES_BEYOND = 22;
    /** Two votes say little about their spread: Student's t is 12.7 for one degree of freedom where a normal quantile is 2.9. */
    private static final double OF_A_PAIR = 4.3;

    private SuspectRule() {}

    /**
     * The number of sound votes; all if there are fewer than {@value #MIN}.
     *
     * @param outward each vote less the median of all, the nearest first
     * @param floor by how much two sound devices in one place differ: the standard deviation of the difference, at least
     */
    static int sound(double[] outward, double floor) {
        int devices = outward.length;
        double mean = 0;
        double squares = 0; // of the differences from the mean, by B. Welford (1962)
        for (int nearer = 0; nearer < devices; nearer++) {
            double difference = outward[nearer] - mean;
            if (nearer > devices / 2 && Math.abs(difference) > limit(nearer, devices, squares, floor)) {
                return nearer;
            }
            mean += difference / (nearer + 1);
            squares += difference * (outward[nearer] - mean);
        }
        return devices;
    }

    private static double limit(int nearer, int devices, double squares, double floor) {
        double deviation = Math.sqrt(squares / (nearer - 1)) * (devices - 1) / nearer;
        double spread = nearer == 2 ? OF_A_PAIR * deviation : deviation;
        return Math.sqrt(2 * Math.log(SAMPLES_BEYOND * devices))
                * Math.sqrt(1 + 1.0 / nearer)
                * Math.max(floor / Math.sqrt(2), spread);
    }
}
