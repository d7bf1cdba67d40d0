package io.furrow.analytics.collision;

import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.clock.ClockSettings;
import io.furrow.analytics.collision.motion.MotionOptions;
import io.furrow.analytics.collision.motion.MotionRules;
import io.furrow.flink.AlignmentOptions;
import io.furrow.flink.JobOptions;
import io.furrow.flink.TopicOptions;
import io.furrow.model.topic.Topics;

/** The options of the job {@code collision}. An accessor refuses a value that no job could start with. */
@Command(
        name = "collision",
        sortOptions = false,
        description =
                "Which devices are closer to each other than a threshold, from when to when. Exact in event time: the "
                        + "same at any parallelism, in any order of arrival and in a second pass.")
public final class CollisionOptions extends JobOptions implements Callable<Integer> {
    @Mixin
    private final TopicOptions topics = new TopicOptions();

    @Mixin
    private final AlignmentOptions alignment = new AlignmentOptions();

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
                    "Topic that says which devices are carried by another and do not collide with it; it need not "
                            + "be there. Default: ${DEFAULT-VALUE}.")
    private String devices;

    @Option(
            names = "--eager",
            description =
                    "Also tell at once, as provisional, of pairs that are close by what has arrived; a start names"
                            + " what it confirms, the rest is withdrawn. Exact records stay the same. Positions that come"
                            + " too late for those take part, if their device told of no newer one.")
    private boolean eager;

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

    @Option(
            names = "--overflow-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.COLLISION_OVERFLOW,
            description =
                    "Topic of cells with a crowd, and of how many pairs --crowd leaves out there. Default: ${DEFAULT-VALUE}.")
    private String overflowOutput;

    @Override
    public Integer call() throws Exception {
        CollisionJob.run(this);
        return 0;
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

    /** What is predicted and crossed; nothing unless asked for. */
    public MotionRules motionRules() {
        try {
            return motion.rules(rules());
        } catch (IllegalArgumentException e) {
            throw refused(e.getMessage(), e);
        }
    }

    public boolean eager() {
        return eager;
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
        return alignment.maxDrift(eager());
    }

    public String output() {
        return output;
    }

    public String overflowOutput() {
        return overflowOutput;
    }

    public String lateOutput() {
        return lateOutput;
    }
}
