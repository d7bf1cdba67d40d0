package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;

/**
 * Where a robot has got to.
 *
 * @param time when that was
 * @param driven seconds of driving behind it
 * @param waited how long it has waited by now for the robot that it lets pass
 * @param passing id of the robot that it passes because it has waited long enough; null where it passes none
 */
public record RobotState(Instant time, double driven, Activity activity, Duration waited, String passing) {
    /** At work from an instant on, with so many seconds of its way behind it. */
    public static RobotState starting(Instant time, double driven) {
        return new RobotState(time, driven, Activity.RUNNING, Duration.ZERO, null);
    }

    /** The same after a command; repeated, it changes nothing. */
    public RobotState told(Command command) {
        boolean stop = command == Command.STOP;
        if (stop == (activity == Activity.STOPPED)) {
            return this;
        }
        return new RobotState(time, driven, stop ? Activity.STOPPED : Activity.RUNNING, Duration.ZERO, passing);
    }
}
