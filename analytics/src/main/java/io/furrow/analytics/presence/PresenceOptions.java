package io.furrow.analytics.presence;

import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.clock.ClockSettings;
import io.furrow.analytics.field.FieldOptions;
import io.furrow.flink.AlignmentOptions;
import io.furrow.flink.JobOptions;
import io.furrow.flink.TopicOptions;
import io.furrow.model.topic.Topics;

/** The options of the job {@code presence}. An accessor refuses a value that no job could start with. */
@Command(
        name = "presence",
        sortOptions = false,
        description =
                "Which device entered and left which field, when, and how long it stayed; also where the field changed"
                        + " or went, or the device fell silent. Exact in event time: the same at any parallelism, in any"
                        + " order of arrival and in a second pass.")
public final class PresenceOptions extends JobOptions implements Callable<Integer> {
    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Mixin
    private final AlignmentOptions alignment = new AlignmentOptions();

    @Mixin
    private final FieldOptions fields = new FieldOptions();

    @Mixin
    private final ClockSettings clocks = new ClockSettings();

    @Option(
            names = "--dwell",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "How long a device must be in a field without a break before it has entered, and out before it has"
                            + " left. Longer: no flicker at the border, records that much later; the times in them are"
                            + " those of going in and out. Default: ${DEFAULT-VALUE}.")
    private Duration dwell;

    @Option(
            names = "--time-to-live",
            paramLabel = "DURATION",
            defaultValue = "5min",
            description =
                    "How long a position counts when no newer one comes; then the device has left, cause silent. At "
                            + "least twice the time between two reports of a device. Default: ${DEFAULT-VALUE}.")
    private Duration timeToLive;

    @Option(
            names = "--output",
            paramLabel = "TOPIC",
            defaultValue = Topics.PRESENCE,
            description = "Topic of the results. Default: ${DEFAULT-VALUE}.")
    private String output;

    @Option(
            names = "--late-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.PRESENCE_LATE,
            description = "Topic of the positions that came too late to count. Default: ${DEFAULT-VALUE}.")
    private String lateOutput;

    @Override
    public Integer call() throws Exception {
        PresenceJob.run(this);
        return 0;
    }

    public PresenceRules rules() {
        try {
            return new PresenceRules(timeToLive, dwell);
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    /** Where the job learns of the fields. */
    public FieldOptions fields() {
        return fields;
    }

    /** What is done about the clocks of devices. */
    public ClockSettings clockSettings() {
        return clocks;
    }

    /** How topics are made. */
    public TopicOptions topics() {
        return topics;
    }

    /** How far partitions may be apart. */
    Optional<Duration> maxDrift() {
        return alignment.maxDrift(false);
    }

    public String output() {
        return output;
    }

    public String lateOutput() {
        return lateOutput;
    }
}
