package io.furrow.analytics.coverage;

import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.stream.Collectors;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.clock.ClockSettings;
import io.furrow.analytics.field.FieldOptions;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/** The options of the job {@code coverage}. An accessor rejects an invalid value. */
@Command(
        name = "coverage",
        sortOptions = false,
        description =
                "What robots have worked of each field, per mission: hectares, share, overlaps, gaps, rate and time left, and "
                        + "a layer of cells. Exact in event time: the same at any parallelism, in any order of arrival and in a "
                        + "second pass.")
public final class CoverageOptions extends AnalyticsOptions {
    @Mixin
    private final FieldOptions fields = new FieldOptions();

    @Mixin
    private final ClockSettings clocks = new ClockSettings();

    @Option(
            names = "--width-attribute",
            paramLabel = "NAME",
            defaultValue = "workingWidth",
            description =
                    "Attribute with the working width of a robot's implement, above 0, at most 100 m: in meters, or in the "
                            + "unit of its metadata. The last value holds. Default: ${DEFAULT-VALUE}.")
    private String widthAttribute;

    @Option(
            names = "--working-width",
            paramLabel = "METERS",
            description =
                    "Working width of robots that do not report it. Set --types with it, because every entity that moves "
                            + "over a field then counts as a robot. Default: they cover nothing.")
    private Double workingWidth;

    @Option(
            names = "--types",
            paramLabel = "TYPE,…",
            split = ",",
            hideParamSyntax = true,
            description = "Entity types of robots, for instance 'Robot,Tractor'. Default: all.")
    private List<String> types = List.of();

    @Option(
            names = "--work-attribute",
            paramLabel = "NAME",
            defaultValue = "working",
            description =
                    "Attribute with the state of a robot's implement. The last value holds from its next position on. A "
                            + "robot that never reports it works while it moves. Default: ${DEFAULT-VALUE}.")
    private String workAttribute;

    @Option(
            names = "--work-values",
            paramLabel = "VALUE,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "true,on,1,working",
            description =
                    "Values of --work-attribute with which the implement works, in any case; also in a ROS message "
                            + "'data' of FIROS. With all others it does not. Default: ${DEFAULT-VALUE}.")
    private List<String> workValues;

    @Option(
            names = "--min-speed",
            paramLabel = "M/S",
            defaultValue = "0.1",
            description =
                    "A robot that moves slower between two positions does not work: the scatter of a standing robot covers "
                            + "nothing. Lower it for robots that creep. Default: ${DEFAULT-VALUE}.")
    private double minSpeed;

    @Option(
            names = "--max-speed",
            paramLabel = "M/S",
            defaultValue = "10",
            description =
                    "A robot that moves faster does not work, or its position is wrong. Default: ${DEFAULT-VALUE}.")
    private double maxSpeed;

    @Option(
            names = "--max-gap",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "Positions of a robot that are further apart in time have nothing covered between them. At least twice "
                            + "the interval between two reports. Default: ${DEFAULT-VALUE}.")
    private Duration maxGap;

    @Option(
            names = "--cell",
            paramLabel = "METERS",
            defaultValue = "0.5",
            description =
                    "Side of a grid cell, the accuracy of the result. A field of more than 4,194,304 cells has cells of a "
                            + "multiple. A changed value applies to coverages that begin after it. Default: ${DEFAULT-VALUE}.")
    private double cell;

    @Option(
            names = "--every",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "Interval of event time between two reports of a coverage that has changed. Default: ${DEFAULT-VALUE}.")
    private Duration every;

    @Option(
            names = "--time-to-live",
            paramLabel = "DURATION",
            defaultValue = "7d",
            description =
                    "How long the coverage of a mission in a field is retained after a robot last worked there; work after "
                            + "that begins at zero. Default: ${DEFAULT-VALUE}.")
    private Duration timeToLive;

    @Option(
            names = "--layer-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.COVERAGE_LAYER,
            description = "Topic of the layers of cells, compacted. Default: ${DEFAULT-VALUE}.")
    private String layerOutput;

    public CoverageOptions() {
        super(AnalyticsKind.COVERAGE);
    }

    CoverageRules rules() {
        try {
            double width = workingWidth == null ? Double.NaN : workingWidth;
            return new CoverageRules(width, minSpeed, maxSpeed, maxGap, cell, every, timeToLive);
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    WorkAttributes attributes() {
        Set<String> on = workValues.stream()
                .map(value -> value.trim().toLowerCase(Locale.ROOT))
                .collect(Collectors.toUnmodifiableSet());
        return new WorkAttributes(Set.copyOf(types), widthAttribute, workAttribute, on);
    }

    FieldOptions fields() {
        return fields;
    }

    ClockSettings clockSettings() {
        return clocks;
    }

    String layerOutput() {
        return layerOutput;
    }

    @Override
    public Set<String> compacted() {
        return Set.of(layerOutput);
    }
}
