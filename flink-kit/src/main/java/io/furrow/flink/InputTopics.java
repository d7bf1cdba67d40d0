package io.furrow.flink;

import java.util.List;
import java.util.Optional;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

/**
 * What {@code --input} names: topics, or where one of the names could not be a topic's, a pattern that takes every topic
 * whose whole name one of them matches, also those that come later, but nothing that a job writes: it would read its own
 * results and set aside again what it has set aside.
 *
 * @param names topics and regular expressions
 */
public record InputTopics(List<String> names) {
    private static final Pattern TOPIC = Pattern.compile("[A-Za-z0-9._-]+");
    private static final String RESULTS = "(?!.*\\.(?:dead|late|overflow|collision|temperature|presence|suspects)$)";

    public InputTopics {
        names = List.copyOf(names);
    }

    /**
     * Empty where all names are topics.
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
                        : Pattern.compile(name).pattern())
                .collect(Collectors.joining("|", "(?:", ")"));
        return Optional.of(Pattern.compile(RESULTS + any));
    }

    private static boolean isTopic(String name) {
        return TOPIC.matcher(name).matches();
    }
}
