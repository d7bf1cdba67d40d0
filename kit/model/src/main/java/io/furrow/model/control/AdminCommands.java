package io.furrow.model.control;

import java.util.Map;
import java.util.Set;

import io.furrow.model.topic.Topics;

/** The commands that only an admin may give, by the topic of their manager; all others an operator may give too. */
public final class AdminCommands {
    private static final Map<String, Set<String>> BY_TOPIC = Map.of(
            Topics.DOMAIN_MANAGER, Set.of("delete"),
            Topics.MISSION_MANAGER, Set.of("delete-template", "rotate-credentials"));

    private AdminCommands() {}

    public static boolean contains(String topic, String command) {
        return BY_TOPIC.getOrDefault(topic, Set.of()).contains(command);
    }
}
