package io.furrow.simulators.robot;

/** The activity of a robot. */
public enum Activity {
    RUNNING,
    /** Stopped by a command. */
    STOPPED,
    /** Letting another robot pass. */
    WAITING
}
