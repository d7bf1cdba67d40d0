package io.furrow.control.mission;

import io.furrow.model.text.Coded;

/** Where a mission is in its life. */
public enum MissionState implements Coded {
    /** There is nothing to do yet: it waits for its start date, or to be started. */
    CREATED,
    /** Its devices are requested and not all of them are up. */
    STARTING,
    RUNNING,
    /** Its devices are no longer wanted and not all of them are gone. */
    STOPPING,
    STOPPED,
    /** It could not start; the status has the reason. */
    FAILED;

    /** Whether it has devices, or waits until they are gone. */
    public boolean isActive() {
        return this == STARTING || this == RUNNING || this == STOPPING;
    }

    /** Whether the one may follow the other. */
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
