package io.furrow.cli.control;

import java.util.List;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/**
 * An instance of an analytics job that belongs to a replay.
 *
 * @param job {@code collision}, {@code presence} or {@code temperature}
 * @param topic of the replay
 */
public record ReplayAnalyticsJob(String job, String topic) {
    private static final Pattern NAME =
            Pattern.compile("(" + String.join("|", AnalyticsKind.jobNames()) + ")-of-([A-Za-z0-9_-]+)\\.([0-9a-f]{8})");

    /** The job of a name as {@link #name} gives it; empty for what does not belong to a replay. */
    public static Optional<ReplayAnalyticsJob> named(String name) {
        Matcher matcher = NAME.matcher(name);
        return matcher.matches()
                ? Optional.of(
                        new ReplayAnalyticsJob(matcher.group(1), Topics.replay(matcher.group(2), matcher.group(3))))
                : Optional.empty();
    }

    /**
     * {@code <job>-of-<mission>.<id8>}: another name than that of an instance which somebody starts without {@code --name}, because what
     * bears this name is ended with the replay.
     */
    public String name() {
        return job + "-of-" + Topics.replayOf(topic).orElseThrow();
    }

    /** Options that make an instance of the job this one. */
    public List<String> options() {
        return List.of("--name", name(), "--input", topic);
    }

    /** Its consumer group. */
    public String group() {
        return "furrow-" + name();
    }
}
