package io.furrow.control.mission;

import java.time.Duration;

import io.furrow.model.event.FiwareScope;

/**
 * Settings of missions.
 *
 * @param timeout how long devices may take to start before missing ones are reported, or to stop before the mission
 *     proceeds without them
 * @param scope tenant and service path of the devices' entities
 * @param simulatedByDefault whether groups of devices are simulated unless they specify it
 * @param devicesPerStep maximum number of devices written in one transaction
 */
public record MissionSettings(Duration timeout, FiwareScope scope, boolean simulatedByDefault, int devicesPerStep) {
    public static final Duration START_TIMEOUT = Duration.ofMinutes(1);

    private static final int DEVICES_PER_STEP = 500;

    public MissionSettings(Duration timeout, FiwareScope scope, boolean simulatedByDefault) {
        this(timeout, scope, simulatedByDefault, DEVICES_PER_STEP);
    }
}
