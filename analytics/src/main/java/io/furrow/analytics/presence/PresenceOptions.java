package io.furrow.analytics.presence;

import java.time.Duration;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.clock.ClockSettings;
import io.furrow.analytics.field.FieldOptions;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.model.result.AnalyticsKind;

/** The options of the job {@code presence}. An accessor rejects an invalid value. */
@Command(
        name = "presence",
        sortOptions = false,
        description =
                "Which device entered and left which field, when, and how long it stayed; also when a field changed "
                        + "or ended or the device became silent. Exact in event time: the same at any parallelism, in any "
                        + "order of arrival and in a second pass.")
public final class PresenceOptions extends AnalyticsOptions {
    @Mixin
    private final FieldOptions fields = new FieldOptions();

    @Mixin
    private final ClockSettings clocks = new ClockSettings();

    @Option(
            names = "--dwell",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "How long a device must be in a field without a break to have entered it, and outside to have left "
                            + "it. Longer: no flicker at the border, but later records; their times are those of going in and out. "
                            + "Default: ${DEFAULT-VALUE}.")
    private Duration dwell;

    @Option(
            names = "--time-to-live",
            paramLabel = "DURATION",
            defaultValue = "5min",
            description =
                    "How long a position counts when no newer one comes; then the device has left with the cause silent. "
                            + "At least twice the interval between two reports of a device. Default: ${DEFAULT-VALUE}.")
    private Duration timeToLive;

    public PresenceOptions() {
        super(AnalyticsKind.PRESENCE);
    }

    public PresenceRules rules() {
        try {
            return new PresenceRules(timeToLive, dwell);
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    public FieldOptions fields() {
        return fields;
    }

    public ClockSettings clockSettings() {
        return clocks;
    }
}
