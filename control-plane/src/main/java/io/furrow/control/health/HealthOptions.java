package io.furrow.control.health;

import java.time.Duration;

import io.furrow.model.device.WantedDevice;

/**
 * When a device counts as silent, and when a mission does.
 *
 * @param periods after how many of its periods without a sign of life
 * @param period of devices that have none of their own
 * @param missionShare above 0, at most 1: share of a mission's devices, three at least, of which the silence is that of the mission
 */
public record HealthOptions(int periods, Duration period, double missionShare) {
    /** So few silent devices never make a silent mission. */
    public static final int LEAST_OF_MISSION = 3;

    /** Three periods; a minute where a device has none; half of a mission. */
    public static final HealthOptions DEFAULT = new HealthOptions(3, Duration.ofMinutes(1), 0.5);

    public HealthOptions {
        if (!(missionShare > 0 && missionShare <= 1)) {
            throw new IllegalArgumentException("the share of a mission is above 0 and at most 1, not " + missionShare);
        }
    }

    /** How long a device may say nothing, ms. */
    long silentAfter(WantedDevice device) {
        return (device.period() == null ? period : device.period())
                .multipliedBy(periods)
                .toMillis();
    }
}
