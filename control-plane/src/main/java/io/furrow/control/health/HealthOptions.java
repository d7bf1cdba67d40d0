package io.furrow.control.health;

import java.time.Duration;

import io.furrow.model.device.WantedDevice;

/**
 * When a device counts as silent.
 *
 * @param periods after how many of its periods without a sign of life
 * @param period of devices that have none of their own
 */
public record HealthOptions(int periods, Duration period) {
    /** Three periods; a minute where a device has none. */
    public static final HealthOptions DEFAULT = new HealthOptions(3, Duration.ofMinutes(1));

    /** How long a device may say nothing, ms. */
    long silentAfter(WantedDevice device) {
        return (device.period() == null ? period : device.period())
                .multipliedBy(periods)
                .toMillis();
    }
}
