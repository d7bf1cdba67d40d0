package io.furrow.analytics.coverage;

import java.io.Serializable;
import java.time.Duration;

/**
 * The rules by which a robot covers a field.
 *
 * @param width working width of robots that report none, meters; NaN if they cover nothing
 * @param minSpeed slower robots do not work, meters per second
 * @param maxSpeed faster ones neither
 * @param maxGap the longest time between two positions of a swath
 * @param cell side of a cell, meters
 * @param every interval between two reports of a coverage
 * @param timeToLive how long a coverage is retained after its last swath
 */
public record CoverageRules(
        double width,
        double minSpeed,
        double maxSpeed,
        Duration maxGap,
        double cell,
        Duration every,
        Duration timeToLive)
        implements Serializable {
    /** Meters. */
    static final double MAX_WIDTH = 100;

    private static final double MIN_CELL = 0.05;
    private static final double MAX_CELL = 100;
    private static final double FASTEST = 50;
    private static final Duration MAX_MAX_GAP = Duration.ofMinutes(10);

    public CoverageRules {
        if (!Double.isNaN(width)) {
            check(isWidth(width), "--working-width must be above 0, at most 100 m");
        }
        check(
                minSpeed >= 0 && minSpeed < maxSpeed && maxSpeed <= FASTEST,
                "--min-speed must be at least 0, and --max-speed greater, at most 50 m/s");
        check(isPositive(maxGap) && maxGap.compareTo(MAX_MAX_GAP) <= 0, "--max-gap must be above 0, at most 10min");
        check(cell >= MIN_CELL && cell <= MAX_CELL, "--cell must be between 0.05 and 100 m");
        check(every.compareTo(Duration.ofSeconds(1)) >= 0, "--every must be at least 1s");
        check(timeToLive.compareTo(maxGap) > 0, "--time-to-live must be longer than --max-gap");
    }

    private static void check(boolean valid, String sentence) {
        if (!valid) {
            throw new IllegalArgumentException(sentence);
        }
    }

    private static boolean isPositive(Duration duration) {
        return !duration.isZero() && !duration.isNegative();
    }

    static boolean isWidth(double meters) {
        return meters > 0 && meters <= MAX_WIDTH;
    }
}
