package io.furrow.connect.sink;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.sink.SinkRecord;
import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.LogManager;
import org.apache.logging.log4j.core.LogEvent;
import org.apache.logging.log4j.core.Logger;
import org.apache.logging.log4j.core.appender.AbstractAppender;
import org.apache.logging.log4j.core.config.Property;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** Records without keys may bring one entity to several tasks, which is worth one warning for each topic. */
class KeylessTopicTest extends SinkFixture {
    private final Warnings warnings = new Warnings();
    private final Logger logger = (Logger) LogManager.getLogger(NgsiSinkTask.class);

    @BeforeEach
    void listen() {
        warnings.start();
        logger.setLevel(Level.WARN);
        logger.addAppender(warnings);
    }

    @AfterEach
    void listenNoMore() {
        logger.removeAppender(warnings);
    }

    @Test
    void isWarnedOfOnceWhereThereAreSeveralTasks() {
        NgsiSinkTask task = start("tasks.max", "2");

        task.put(List.of(record("bare", null), record("bare", null), record("keyed", "a")));
        task.put(List.of(record("bare", null)));

        assertThat(warnings.sentences)
                .singleElement()
                .asString()
                .contains("Topic bare", "without key", "known.max.age.ms", "tasks.max=1");
    }

    @Test
    void doesNoHarmWhereThereIsOneTask() {
        start("tasks.max", "1").put(List.of(record("bare", null)));

        assertThat(warnings.sentences).isEmpty();
    }

    private static SinkRecord record(String topic, String key) {
        return new SinkRecord(topic, 0, null, key, null, entity("a", "x", 1), 0, 1L, TimestampType.CREATE_TIME);
    }

    private static final class Warnings extends AbstractAppender {
        private final List<String> sentences = new CopyOnWriteArrayList<>();

        private Warnings() {
            super("warnings", null, null, true, Property.EMPTY_ARRAY);
        }

        @Override
        public void append(LogEvent event) {
            if (event.getLevel() == Level.WARN) {
                sentences.add(event.getMessage().getFormattedMessage());
            }
        }
    }
}
