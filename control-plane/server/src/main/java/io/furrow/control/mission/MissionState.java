package io.furrow.control.mission;

import io.furrow.model.text.Coded;

/** State in the life cycle of a mission. */
public enum MissionState implements Coded {
    /** It waits for its start date, or for a start command. */
    CREATED,
    /** Its devices are requested, but not all of them are up. */
    STARTING,
    RUNNING,
    /** Its devices are no longer desired, but not all of them have stopped. */
    STOPPING,
    STOPPED,
    /** It could not start; the status has the reason. */
    FAILED;

    /** Whether it has devices or waits until they have stopped. */
    public boolean isActive() {
        return this == STARTING || this == RUNNING || this == STOPPING;
    }

    public boolean canBecome(MissionState next) {
        return switch (this) {
            case CREATED -> next == CREATED || next == STARTING || next == STOPPED || next == FAILED;
            case STARTING -> next == RUNNING || next == STOPPING || next == FAILED;
            case RUNNING -> next == STOPPING;
            case STOPPING -> next == STOPPED;
            case STOPPED, FAILED -> next == CREATED || next == STARTING;
        };
    }
}
