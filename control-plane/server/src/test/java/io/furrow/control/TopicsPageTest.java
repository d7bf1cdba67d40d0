package io.furrow.control;

import java.io.IOException;
import java.lang.reflect.Field;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.Test;

import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

/** Compares the table of topics in docs/topics.md with the topics of the code and their cleanup policies. */
class TopicsPageTest {
    private static final Path PAGE = Path.of("..", "..", "docs", "topics.md");
    private static final Pattern ROW = Pattern.compile("\\| ((?:`[^`|]+`(?:, )?)+) \\|.*\\|");
    private static final Pattern NAME = Pattern.compile("`([^`]+)`");

    @Test
    void namesEachTopic() throws IOException {
        List<String> names = Stream.of(Topics.class.getFields())
                .filter(field -> field.getType() == String.class)
                .map(TopicsPageTest::value)
                .toList();

        assertThat(rows()).containsKeys(names.toArray(String[]::new));
        assertThat(rows()).containsKeys(AnalyticsKind.allTopics().toArray(String[]::new));
    }

    @Test
    void namesTheCleanupPolicyAndRetentionOfEachTopic() throws IOException {
        Map<String, String> rows = rows();

        assertThat(ServiceTopics.desired(ControlSettings.of(new Properties())))
                .filteredOn(topic -> !topic.name().endsWith(".dead"))
                .allSatisfy(topic -> {
                    assertThat(rows.get(topic.name()).contains("compacted"))
                            .as(topic.name())
                            .isEqualTo("compact".equals(config(topic, "cleanup.policy")));
                    assertThat(rows.get(topic.name()).contains("retained for a year"))
                            .as(topic.name())
                            .isEqualTo("31536000000".equals(config(topic, "retention.ms")));
                });
    }

    private static String config(NewTopic topic, String name) {
        return topic.configs().get(name);
    }

    private static Map<String, String> rows() throws IOException {
        Map<String, String> rows = new LinkedHashMap<>();
        for (String line : Files.readAllLines(PAGE)) {
            Matcher row = ROW.matcher(line);
            if (row.matches()) {
                NAME.matcher(row.group(1)).results().forEach(name -> rows.putIfAbsent(name.group(1), line));
            }
        }
        return rows;
    }

    private static String value(Field field) {
        try {
            return (String) field.get(null);
        } catch (IllegalAccessException e) {
            throw new IllegalStateException(e);
        }
    }
}
