package io.furrow.analytics.temperature;

import java.time.Duration;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.field.FieldOptions;
import io.furrow.flink.JobOptions;
import io.furrow.model.topic.Topics;

/** The options of the job {@code temperature}. An accessor refuses a value that no job could start with. */
@Command(
        name = "temperature",
        sortOptions = false,
        description =
                "The average temperature of each field in event-time windows. Each device has one vote per window, "
                        + "its median; devices that are far from the others are set aside and named as suspects.")
public final class TemperatureOptions extends JobOptions implements Callable<Integer> {
    @Mixin
    private final FieldOptions fields = new FieldOptions();

    @Option(
            names = "--attribute",
            paramLabel = "NAME",
            defaultValue = "Temperature",
            description = "Attribute that holds the reading. Default: ${DEFAULT-VALUE}.")
    private String attribute;

    @Option(
            names = "--window",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "Length of a window. Longer: more readings per device, fewer results. Default: ${DEFAULT-VALUE}.")
    private Duration window;

    @Option(
            names = "--slide",
            paramLabel = "DURATION",
            description =
                    "Time from the start of a window to the start of the next, a whole part of --window. Default: "
                            + "--window, so that windows do not overlap.")
    private Duration slide;

    @Option(
            names = "--allowed-lateness",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description = "How long after its end a window still takes late readings; each sends the result again, "
                    + "corrected. What comes later goes to --late-output. Default: ${DEFAULT-VALUE}.")
    private Duration allowedLateness;

    @Option(
            names = "--mad-floor",
            paramLabel = "NUMBER",
            defaultValue = "0",
            description = "Least median absolute deviation to judge devices by, in the attribute's unit. Raise it where"
                    + " thermometers agree so well that a tenth of a degree makes one suspect. Default:"
                    + " ${DEFAULT-VALUE}.")
    private double madFloor;

    @Option(
            names = "--repeat-window",
            paramLabel = "DURATION",
            description = "How long an event is remembered, so that a repetition counts once. Default: --window plus "
                    + "--allowed-lateness: after that a repetition is late.")
    private Duration repeatWindow;

    @Option(
            names = "--output",
            paramLabel = "TOPIC",
            defaultValue = Topics.TEMPERATURE,
            description = "Topic of the results. Default: ${DEFAULT-VALUE}.")
    private String output;

    @Option(
            names = "--late-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.TEMPERATURE_LATE,
            description = "Topic of the readings that came too late to count. Default: ${DEFAULT-VALUE}.")
    private String lateOutput;

    @Override
    public Integer call() throws Exception {
        TemperatureJob.run(this);
        return 0;
    }

    /** Where the job learns of the fields. */
    FieldOptions fields() {
        return fields;
    }

    public String attribute() {
        return attribute;
    }

    public Duration window() {
        return positive("--window", window);
    }

    public Duration slide() {
        Duration step = slide == null ? window() : positive("--slide", slide);
        if (window().toMillis() % step.toMillis() != 0) {
            throw refused("--slide must be a whole part of --window, for instance 1min of 5min", null);
        }
        return step;
    }

    public Duration allowedLateness() {
        return allowedLateness;
    }

    public double madFloor() {
        if (!Double.isFinite(madFloor) || madFloor < 0) {
            throw refused("--mad-floor must be 0 or a positive number", null);
        }
        return madFloor;
    }

    public Duration repeatWindow() {
        return repeatWindow == null ? window().plus(allowedLateness) : positive("--repeat-window", repeatWindow);
    }

    public String output() {
        return output;
    }

    public String lateOutput() {
        return lateOutput;
    }

    private Duration positive(String option, Duration value) {
        if (value.isZero()) {
            throw refused(option + " must be longer than 0, for instance 1min", null);
        }
        return value;
    }
}
