package io.furrow.analytics.collision;

import java.time.Duration;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.flink.JobOptions;
import io.furrow.model.topic.Topics;

/** The options of the job {@code collision}. An accessor refuses a value that no job could start with. */
@Command(
        name = "collision",
        sortOptions = false,
        description =
                "Which devices are closer to each other than a threshold, from when to when. Exact in event time: the "
                        + "same at any parallelism, in any order of arrival and in a second pass.")
public final class CollisionOptions extends JobOptions implements Callable<Integer> {
    private static final int THRESHOLDS_PER_CELL = 20;

    @Option(
            names = "--threshold",
            paramLabel = "METERS",
            defaultValue = "5",
            description = "Up to this distance two devices are close, 0.1 to 100000 m. Default: ${DEFAULT-VALUE}.")
    private double threshold;

    @Option(
            names = "--time-to-live",
            paramLabel = "DURATION",
            defaultValue = "30s",
            description = "How long a position counts when no newer one comes. At least twice the time between two "
                    + "reports of a device, or encounters break up. Default: ${DEFAULT-VALUE}.")
    private Duration timeToLive;

    @Option(
            names = "--max-skew",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description = "Positions further apart in time are not compared. 0s compares all. Set it where devices "
                    + "move far between two reports. Default: ${DEFAULT-VALUE}.")
    private Duration maxSkew;

    @Option(
            names = "--ongoing-every",
            paramLabel = "DURATION",
            defaultValue = "1s",
            description = "Least event time between two records of a lasting encounter; starts and ends are always "
                    + "told. 0s tells every sighting. Default: ${DEFAULT-VALUE}.")
    private Duration ongoingEvery;

    @Option(
            names = "--cell",
            paramLabel = "METERS",
            description = "Height of a grid cell, at least --threshold. Changes speed only: smaller where devices "
                    + "crowd, larger where they are sparse. Default: 20 times --threshold.")
    private Double cell;

    @Option(
            names = "--output",
            paramLabel = "TOPIC",
            defaultValue = Topics.COLLISION,
            description = "Topic of the encounters. Default: ${DEFAULT-VALUE}.")
    private String output;

    @Option(
            names = "--late-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.COLLISION_LATE,
            description = "Topic of the positions that came too late to count. Default: ${DEFAULT-VALUE}.")
    private String lateOutput;

    @Override
    public Integer call() throws Exception {
        CollisionJob.run(this);
        return 0;
    }

    public CollisionRules rules() {
        double cellMeters = cell == null ? THRESHOLDS_PER_CELL * threshold : cell;
        try {
            return new CollisionRules(threshold, timeToLive, maxSkew, ongoingEvery, cellMeters);
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    public String output() {
        return output;
    }

    public String lateOutput() {
        return lateOutput;
    }
}
