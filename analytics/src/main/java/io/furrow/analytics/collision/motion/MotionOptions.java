package io.furrow.analytics.collision.motion;

import java.time.Duration;
import java.util.List;
import java.util.Set;

import picocli.CommandLine.Option;

import io.furrow.analytics.collision.rules.CollisionRules;

/** The options of the job {@code collision} for predictions and crossings. */
public final class MotionOptions {
    @Option(
            names = "--horizon",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "How far the course of a device is extrapolated from its newest position. A pair that will be within "
                            + "the threshold by then is reported with the phase 'predicted', 'tcpa' and 'dcpa'. 0s predicts "
                            + "nothing; 10s suits machines that report once a second. Default: ${DEFAULT-VALUE}.")
    private Duration horizon;

    @Option(
            names = "--crossed",
            description =
                    "Also compare the paths between two reports: a pair that is within the threshold only there is "
                            + "reported with the phase 'crossed'. Set it if devices move further than the threshold between two "
                            + "reports.")
    private boolean crossed;

    @Option(
            names = "--max-speed",
            paramLabel = "M/S",
            defaultValue = "30",
            description =
                    "Maximum speed of a device, in meters per second. A faster position counts as faulty: predictions "
                            + "and crossings ignore it, and the metric 'positionsTooFast' counts it. Default: ${DEFAULT-VALUE}.")
    private double maxSpeed;

    @Option(
            names = "--moving-types",
            paramLabel = "TYPE",
            split = ",",
            description =
                    "Entity types for which predictions and crossings are computed, for instance 'Robot,Tractor'. "
                            + "Default: all.")
    private List<String> movingTypes = List.of();

    /**
     * @param common the rules of encounters
     * @throws IllegalArgumentException if the options are invalid; the message is for the user
     */
    public MotionRules rules(CollisionRules common) {
        return new MotionRules(common, horizon, crossed, maxSpeed, Set.copyOf(movingTypes));
    }
}
