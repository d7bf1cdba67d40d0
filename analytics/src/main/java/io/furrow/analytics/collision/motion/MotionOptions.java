package io.furrow.analytics.collision.motion;

import java.time.Duration;
import java.util.List;
import java.util.Set;

import picocli.CommandLine.Option;

import io.furrow.analytics.collision.rules.CollisionRules;

/** The options of the job {@code collision} about what lies ahead of devices and between their reports. */
public final class MotionOptions {
    @Option(
            names = "--horizon",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "How far ahead of its newest position the course of a device is followed. A pair that will come "
                            + "within the threshold by then is reported with the phase 'predicted', 'tcpa' and 'dcpa'. 0s predicts "
                            + "nothing and costs nothing; 10s suits machines that report once a second. Default: ${DEFAULT-VALUE}.")
    private Duration horizon;

    @Option(
            names = "--crossed",
            description =
                    "Compare the ways between two reports too: a pair that comes within the threshold there, though "
                            + "no report shows it, is reported with the phase 'crossed'. Set it where devices move further between "
                            + "two reports than the threshold.")
    private boolean crossed;

    @Option(
            names = "--max-speed",
            paramLabel = "M/S",
            defaultValue = "30",
            description =
                    "No device moves faster, in meters per second. What seems faster is taken for a faulty position: "
                            + "it has no part in predictions and crossings and is counted as 'positionsTooFast'. "
                            + "Default: ${DEFAULT-VALUE}.")
    private double maxSpeed;

    @Option(
            names = "--moving-types",
            paramLabel = "TYPE",
            split = ",",
            description =
                    "Entity types among which is predicted and crossed, for instance 'Robot,Tractor'. Default: all.")
    private List<String> movingTypes = List.of();

    /**
     * @param common the rules of encounters
     * @throws IllegalArgumentException with a sentence for whoever set the options
     */
    public MotionRules rules(CollisionRules common) {
        return new MotionRules(common, horizon, crossed, maxSpeed, Set.copyOf(movingTypes));
    }
}
