package io.furrow.cli.control;

import java.util.List;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/**
 * An analytics job instance that belongs to a replay.
 *
 * @param job {@code collision}, {@code presence} or {@code temperature}
 * @param topic of the replay
 */
public record ReplayAnalyticsJob(String job, String topic) {
    private static final Pattern NAME =
            Pattern.compile("(" + String.join("|", AnalyticsKind.jobNames()) + ")-of-([A-Za-z0-9_-]+)\\.([0-9a-f]{8})");

    /** Parses a name as of {@link #name}; empty for jobs that do not belong to a replay. */
    public static Optional<ReplayAnalyticsJob> named(String name) {
        Matcher matcher = NAME.matcher(name);
        return matcher.matches()
                ? Optional.of(
                        new ReplayAnalyticsJob(matcher.group(1), Topics.replay(matcher.group(2), matcher.group(3))))
                : Optional.empty();
    }

    /**
     * {@code <job>-of-<mission>.<id8>}. Differs from the name of an instance started by hand without {@code --name}, because jobs of
     * this name end with the replay.
     */
    public String name() {
        return job + "-of-" + Topics.replayOf(topic).orElseThrow();
    }

    /** The options of this instance of the job. */
    public List<String> options() {
        return List.of("--name", name(), "--input", topic);
    }

    /** Its consumer group. */
    public String group() {
        return "furrow-" + name();
    }
}
