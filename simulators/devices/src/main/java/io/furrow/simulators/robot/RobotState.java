package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;

/**
 * The progress of a robot.
 *
 * @param driven seconds of driving so far
 * @param waited time it has waited for the robot that it lets pass
 * @param passing id of the robot that it passes after waiting the maximum time; null for none
 */
public record RobotState(Instant time, double driven, Activity activity, Duration waited, String passing) {
    /** Running from an instant on, with this many seconds of its way completed. */
    public static RobotState starting(Instant time, double driven) {
        return new RobotState(time, driven, Activity.RUNNING, Duration.ZERO, null);
    }

    /** The state after a command to stop or to continue; a repeated command changes nothing. */
    public RobotState commanded(boolean stop) {
        if (stop == (activity == Activity.STOPPED)) {
            return this;
        }
        return new RobotState(time, driven, stop ? Activity.STOPPED : Activity.RUNNING, Duration.ZERO, passing);
    }
}
