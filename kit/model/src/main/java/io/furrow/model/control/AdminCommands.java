package io.furrow.model.control;

import java.util.Map;
import java.util.Set;

import io.furrow.model.topic.Topics;

/** Lists the commands that need the role of an admin, by the topic of their manager; operators may give all others. */
public final class AdminCommands {
    private static final Map<String, Set<String>> BY_TOPIC = Map.of(
            Topics.DOMAIN_MANAGER, Set.of("delete"),
            Topics.MISSION_MANAGER, Set.of("delete-template", "rotate-credentials"));

    private AdminCommands() {}

    public static boolean contains(String topic, String command) {
        return BY_TOPIC.getOrDefault(topic, Set.of()).contains(command);
    }
}
