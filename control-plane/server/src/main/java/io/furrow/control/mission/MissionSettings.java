package io.furrow.control.mission;

import java.time.Duration;

import io.furrow.model.event.FiwareScope;

/**
 * What missions are run by.
 *
 * @param timeout how long devices may take to come up before those that are missing are reported, or to go before the mission
 *     continues without them
 * @param scope tenant and service path of the devices' entities
 * @param simulatedByDefault whether groups of devices that do not say so are simulated
 * @param devicesPerStep how many devices are written in one transaction
 */
public record MissionSettings(Duration timeout, FiwareScope scope, boolean simulatedByDefault, int devicesPerStep) {
    /** Default of {@code timeout}. */
    public static final Duration START_TIMEOUT = Duration.ofMinutes(1);

    private static final int DEVICES_PER_STEP = 500;

    public MissionSettings(Duration timeout, FiwareScope scope, boolean simulatedByDefault) {
        this(timeout, scope, simulatedByDefault, DEVICES_PER_STEP);
    }
}
