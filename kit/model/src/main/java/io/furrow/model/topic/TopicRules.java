package io.furrow.model.topic;

import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

/**
 * Decides which topics may be read and written.
 *
 * @param readable names, with {@code *} as wildcard
 * @param writable likewise
 */
public record TopicRules(List<String> readable, List<String> writable) {
    private static final Pattern LEGAL = Pattern.compile("[A-Za-z0-9._*-]{1,249}");

    /**
     * Data and control topics are readable, except dead letters; the topics of requests to the managers are writable.
     */
    public static final TopicRules DEFAULT = new TopicRules(
            List.of("data.*", "service.*"),
            List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER));

    /** @throws IllegalArgumentException if a pattern cannot match a topic */
    public TopicRules {
        readable = checked(readable);
        writable = checked(writable);
    }

    private static List<String> checked(List<String> patterns) {
        for (String pattern : patterns) {
            if (!LEGAL.matcher(pattern).matches()) {
                throw new IllegalArgumentException(
                        "'%s' names no topics; letters, digits, '.', '_', '-' and '*' do".formatted(pattern));
            }
        }
        return List.copyOf(patterns);
    }

    public boolean mayRead(String topic) {
        return matches(readable, topic) && Topics.ofDeadLetters(topic).isEmpty();
    }

    public boolean mayWrite(String topic) {
        return matches(writable, topic);
    }

    private static boolean matches(List<String> patterns, String topic) {
        return patterns.stream().anyMatch(pattern -> matches(pattern, topic));
    }

    private static boolean matches(String pattern, String topic) {
        String expression =
                List.of(pattern.split("\\*", -1)).stream().map(Pattern::quote).collect(Collectors.joining(".*"));
        return Pattern.matches(expression, topic);
    }
}
