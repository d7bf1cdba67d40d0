package io.furrow.analytics.collision;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.clock.ClockSettings;
import io.furrow.analytics.collision.motion.MotionOptions;
import io.furrow.analytics.collision.motion.MotionRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/** The options of the job {@code collision}. An accessor rejects an invalid value. */
@Command(
        name = "collision",
        sortOptions = false,
        description =
                "Which devices are closer to each other than a threshold, from when to when. Exact in event time: the "
                        + "same at any parallelism, in any order of arrival and in a second pass.")
public final class CollisionOptions extends AnalyticsOptions {
    @Mixin
    private final RuleOptions rules = new RuleOptions();

    @Mixin
    private MotionOptions motion;

    @Mixin
    private final ClockSettings clocks = new ClockSettings();

    @Option(
            names = "--devices",
            paramLabel = "TOPIC",
            defaultValue = Topics.DEVICES,
            description =
                    "Topic that says which devices another device carries, so that they do not collide with it; it may "
                            + "be missing. Default: ${DEFAULT-VALUE}.")
    private String devices;

    @Option(
            names = "--overflow-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.COLLISION_OVERFLOW,
            description = "Topic of crowded cells, with the number of pairs that --crowd skips there. Default: "
                    + "${DEFAULT-VALUE}.")
    private String overflowOutput;

    public CollisionOptions() {
        super(AnalyticsKind.COLLISION);
    }

    public CollisionRules rules() {
        try {
            return rules.rules();
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    public String devices() {
        return devices;
    }

    /** The rules of predictions and crossings, both off by default. */
    public MotionRules motionRules() {
        try {
            return motion.rules(rules());
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    public ClockSettings clockSettings() {
        return clocks;
    }

    public String overflowOutput() {
        return overflowOutput;
    }
}
