package io.furrow.model.result;

import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Stream;

import io.furrow.model.topic.Topics;

/** The analytics jobs. Whoever lists jobs, or the topics of their results, lists them from here. */
public enum AnalyticsKind {
    COLLISION(Topics.COLLISION, Topics.COLLISION_LATE),
    PRESENCE(Topics.PRESENCE, Topics.PRESENCE_LATE),
    TEMPERATURE(Topics.TEMPERATURE, Topics.TEMPERATURE_LATE);

    private final String topic;
    private final String lateTopic;

    AnalyticsKind(String topic, String lateTopic) {
        this.topic = topic;
        this.lateTopic = lateTopic;
    }

    /** The job of a name in lower case, such as {@code collision}. */
    public static Optional<AnalyticsKind> named(String name) {
        return Arrays.stream(values())
                .filter(kind -> kind.jobName().equals(name))
                .findAny();
    }

    public static List<String> jobNames() {
        return Arrays.stream(values()).map(AnalyticsKind::jobName).toList();
    }

    /** Where the live jobs write their results. */
    public static List<String> topics() {
        return Arrays.stream(values()).map(kind -> kind.topic).toList();
    }

    /** Where the live jobs write: results, and what came too late for them. */
    public static Stream<String> allTopics() {
        return Arrays.stream(values()).flatMap(kind -> Stream.of(kind.topic, kind.lateTopic));
    }

    /** Of a job, and the last part of the topic of its results on a replay. */
    public String jobName() {
        return name().toLowerCase(Locale.ROOT);
    }
}
