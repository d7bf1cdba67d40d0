package io.furrow.simulators.robot;

/** What a robot is doing. */
public enum Activity {
    RUNNING,
    /** Told to stop. */
    STOPPED,
    /** Something lies on its way. */
    BLOCKED,
    /** It lets another robot pass. */
    WAITING
}
