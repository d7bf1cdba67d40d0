package io.furrow.model.result;

import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Stream;

import io.furrow.model.topic.Topics;

/** The analytics jobs, with the topics of their results. */
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

    /** Returns the job of a name in lower case, such as {@code collision}. */
    public static Optional<AnalyticsKind> named(String name) {
        return Arrays.stream(values())
                .filter(kind -> kind.jobName().equals(name))
                .findAny();
    }

    public static List<String> jobNames() {
        return Arrays.stream(values()).map(AnalyticsKind::jobName).toList();
    }

    /** Returns the result topics of the live jobs. */
    public static List<String> topics() {
        return Arrays.stream(values()).map(kind -> kind.topic).toList();
    }

    /** Returns all topics of the live jobs: results and late records. */
    public static Stream<String> allTopics() {
        return Arrays.stream(values()).flatMap(kind -> Stream.of(kind.topic, kind.lateTopic));
    }

    /** Returns the name of the job, which is also the last part of its result topic for a replay. */
    public String jobName() {
        return name().toLowerCase(Locale.ROOT);
    }
}
