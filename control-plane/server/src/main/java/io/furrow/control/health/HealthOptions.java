package io.furrow.control.health;

import java.time.Duration;

import io.furrow.model.device.DesiredDevice;

/**
 * Options for the silence of devices and missions.
 *
 * @param periods number of a device's periods without a heartbeat after which it is silent
 * @param period default for devices without a period of their own
 * @param missionShare above 0, at most 1: share of a mission's devices, at least three, whose silence makes the mission
 * silent
 */
public record HealthOptions(int periods, Duration period, double missionShare) {
    /** Minimum number of silent devices of a silent mission. */
    static final int MIN_OF_MISSION = 3;

    /** Three periods, a default period of one minute, half of a mission. */
    public static final HealthOptions DEFAULT = new HealthOptions(3, Duration.ofMinutes(1), 0.5);

    public HealthOptions {
        if (!(missionShare > 0 && missionShare <= 1)) {
            throw new IllegalArgumentException(
                    "the share of silent devices of a mission must be above 0 and at most 1, not " + missionShare);
        }
    }

    /** Time without a report after which a device is silent, ms. */
    long silentAfter(DesiredDevice device) {
        return (device.period() == null ? period : device.period())
                .multipliedBy(periods)
                .toMillis();
    }
}
