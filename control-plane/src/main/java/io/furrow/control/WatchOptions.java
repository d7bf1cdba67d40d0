package io.furrow.control;

import java.time.Duration;

import io.furrow.control.health.HealthOptions;

/**
 * What the farm is watched by.
 *
 * @param health when a device counts as silent
 * @param predictionHolds how long a predicted encounter is taken for right when it is not told again
 */
public record WatchOptions(HealthOptions health, Duration predictionHolds) {
    /** Silent after three periods; a prediction holds for a minute. */
    public static final WatchOptions DEFAULT = new WatchOptions(HealthOptions.DEFAULT, Duration.ofMinutes(1));
}
