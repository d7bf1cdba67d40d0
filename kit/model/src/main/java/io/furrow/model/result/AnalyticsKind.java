package io.furrow.model.result;

import java.util.Arrays;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Stream;

/** The analytics jobs, with the topics of their results. */
public enum AnalyticsKind {
    COLLISION,
    COVERAGE,
    PRESENCE,
    TEMPERATURE;

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
        return Arrays.stream(values()).map(AnalyticsKind::topic).toList();
    }

    /** Returns all topics of the live jobs: results and late records. */
    public static Stream<String> allTopics() {
        return Arrays.stream(values()).flatMap(kind -> Stream.of(kind.topic(), kind.lateTopic()));
    }

    /** Returns the topic of the results. */
    public String topic() {
        return "data." + jobName();
    }

    /** Returns the topic of the records that came after their results. */
    public String lateTopic() {
        return topic() + ".late";
    }

    /** Returns the name of the job, which is also the last part of its result topic for a replay. */
    public String jobName() {
        return name().toLowerCase(Locale.ROOT);
    }
}
