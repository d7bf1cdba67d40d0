package io.furrow.ingest.normalize;

import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import picocli.CommandLine.Command;
import picocli.CommandLine.IDefaultValueProvider;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.ArgSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Option;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.job.WithoutEventTime;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.NotificationRules;
import io.furrow.model.event.Origin;
import io.furrow.model.topic.Topics;

/** The options of the job {@code normalize}. */
@Command(
        name = "normalize",
        description = "Converts the context broker's native Kafka notifications, in any format, to events on data.raw.",
        defaultValueProvider = NormalizeOptions.OwnDefaults.class,
        modelTransformer = WithoutEventTime.class)
public final class NormalizeOptions extends JobOptions {
    static final String MAX_CLOCK_SKEW = "--max-clock-skew";
    private static final Duration HOUR = Duration.ofHours(1);

    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Option(
            names = "--output",
            paramLabel = "TOPIC",
            defaultValue = Topics.RAW,
            description = "Topic to write events to. Default: ${DEFAULT-VALUE}.")
    private String output;

    @Option(
            names = "--exclude-types",
            paramLabel = "REGEX,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "Analytics:.*,Domain,Mission",
            description =
                    "An entity whose whole type matches one is dropped and counted. Name the types that are written from "
                            + "Kafka into the context broker; otherwise they return as new events. Default: ${DEFAULT-VALUE}.")
    private List<String> excludeTypes;

    @Option(
            names = MAX_CLOCK_SKEW,
            paramLabel = "DURATION",
            defaultValue = "5min",
            description =
                    "How far a device's clock may be ahead, less than an hour; beyond that the event gets the time of "
                            + "the notification. Default: ${DEFAULT-VALUE}.")
    private Duration maxClockSkew;

    @Option(
            names = "--event-time",
            paramLabel = "SOURCE,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "device,attributes,entity",
            description =
                    "Source of the event time: the first of these that is present. device: the attribute Time, else "
                            + "TimeInstant, dateObserved, timestamp. attributes: the newest metadata dateModified of the "
                            + "attributes. entity: its dateModified. Without any of them the event gets the time of the "
                            + "notification. Default: ${DEFAULT-VALUE}.")
    private List<String> eventTime;

    @Option(
            names = "--max-record-bytes",
            paramLabel = "N",
            defaultValue = "8388608",
            description =
                    "An entity whose record would be larger becomes a dead letter, because a record that the broker "
                            + "refuses stops the job. Default: ${DEFAULT-VALUE}.")
    private int maxRecordBytes;

    /** The default of all jobs that differs for this one. */
    static final class OwnDefaults implements IDefaultValueProvider {
        @Override
        public String defaultValue(ArgSpec argument) {
            return argument instanceof OptionSpec option && option.longestName().equals("--input")
                    ? Topics.NOTIFICATIONS
                    : null;
        }
    }

    /** Settings for new topics. */
    public TopicOptions topics() {
        return topics;
    }

    /** The settings of the translation. */
    NormalizeNotifications.Settings settings() {
        NotificationRules rules =
                new NotificationRules(NormalizeNotifications.STAGE, excluded(), times(), Origin.KAFKA);
        return new NormalizeNotifications.Settings(output, rules, maxRecordBytes);
    }

    private List<Pattern> excluded() {
        try {
            return excludeTypes.stream().map(Pattern::compile).toList();
        } catch (PatternSyntaxException e) {
            throw refused(
                    "--exclude-types " + e.getPattern() + " is not a regular expression: " + e.getDescription(), e);
        }
    }

    private EventTimeRule times() {
        if (maxClockSkew.compareTo(HOUR) >= 0) {
            throw refused(MAX_CLOCK_SKEW + " is an hour or more; write for instance 5min", null);
        }
        try {
            return EventTimeRule.of(eventTime, maxClockSkew);
        } catch (IllegalArgumentException e) {
            throw refused("--event-time: " + e.getMessage(), e);
        }
    }
}
