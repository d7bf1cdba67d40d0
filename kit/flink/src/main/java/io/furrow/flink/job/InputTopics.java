package io.furrow.flink.job;

import java.util.List;
import java.util.Optional;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

/**
 * The topics of {@code --input}: names, or, if one of them cannot be a topic's name, a pattern that matches the topics named in full and
 * every topic whose whole name a regular expression matches, also future ones. Expressions never match dead letters or results of
 * analytics: a job would read its own output. They match a mission's own topic whatever the mission's name. They never match a replay: its
 * event time requires a separate instance, so a replay must be the only topic, named in full.
 *
 * @param names topics and regular expressions
 */
public record InputTopics(List<String> names) {
    private static final Pattern TOPIC = Pattern.compile("[A-Za-z0-9._-]+");
    private static final String NO_REPLAY = "(?!data\\.[^.]+\\.replay\\.)";
    private static final String MISSION = "data\\.[^.]+\\.realtime\\.[^.]+$";
    /** No mission's topic ends in {@code .dead}, see {@link io.furrow.model.topic.TopicName}. */
    private static final String NO_RESULTS = "(?!.*\\.dead$)(?=" + MISSION
            + "|(?!.*\\.(?:late|layer|overflow|suspects|clocks|" + String.join("|", AnalyticsKind.jobNames()) + ")$))";

    public InputTopics {
        names = List.copyOf(names);
    }

    /**
     * Empty if all names are topics.
     *
     * @throws java.util.regex.PatternSyntaxException if a name is neither a topic nor a regular expression
     */
    public Optional<Pattern> pattern() {
        if (names.stream().allMatch(InputTopics::isTopic)) {
            return Optional.empty();
        }
        String any = names.stream()
                .map(name -> isTopic(name)
                        ? Pattern.quote(name)
                        : NO_REPLAY + NO_RESULTS + "(?:" + Pattern.compile(name).pattern() + ")")
                .collect(Collectors.joining("|"));
        return Optional.of(Pattern.compile(any));
    }

    /** The topic of the replay to read; empty for live topics. */
    public Optional<String> replay() {
        return names.stream().filter(Topics::isReplay).findFirst();
    }

    /**
     * Why these topics cannot be read together, and the remedy; empty if they can.
     *
     * @param job name of the command
     */
    Optional<String> refusal(String job) {
        Optional<String> replay = replay();
        if (replay.isPresent() && names.stream().distinct().count() > 1) {
            return Optional.of(
                    "a replay shares its event time with no other topic; start an instance for it alone, '%s --input %s', and one for the others"
                            .formatted(job, replay.get()));
        }
        return names.stream()
                .filter(InputTopics::spellsReplay)
                .findFirst()
                .map(name ->
                        "a pattern takes no replays, each of which has an event time of its own; start an instance for each, '%s --input data.<mission>.replay.<id8>'"
                                .formatted(job));
    }

    /** Whether a pattern, without its escapes, names a replay's topic; one that only matches some reads live topics. */
    private static boolean spellsReplay(String name) {
        return !isTopic(name) && name.replaceAll("[\\\\\\[\\]]", "").contains(".replay.");
    }

    private static boolean isTopic(String name) {
        return TOPIC.matcher(name).matches();
    }
}
