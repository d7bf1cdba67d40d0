package io.furrow.control.mission;

import java.time.Duration;

import io.furrow.model.event.FiwareScope;

/**
 * What missions are run by.
 *
 * @param timeout how long devices may take to come up or to go, before the mission continues without them
 * @param scope tenant and service path of the devices' entities
 * @param devicesPerStep how many devices are written in one transaction
 */
public record MissionOptions(Duration timeout, FiwareScope scope, int devicesPerStep) {
    private static final int DEVICES_PER_STEP = 500;

    public MissionOptions(Duration timeout, FiwareScope scope) {
        this(timeout, scope, DEVICES_PER_STEP);
    }
}
