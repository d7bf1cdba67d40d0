package io.furrow.connect.sink;

import java.util.List;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** What a task does where another one may write the same entity. */
class TwoTasksTest extends SinkFixture {
    private NgsiSinkTask one;
    private NgsiSinkTask other;

    @BeforeEach
    void startBoth() {
        one = start("delete.on.null", "true", "known.max.age.ms", "0", "task.index", "0");
        other = start("task.index", "1");
    }

    @Test
    void keepTheNewestValueBecauseEachReadsAgainWhatIsTooOld() {
        one.put(List.of(record("a", "x", 1, 50)));
        other.put(List.of(record("a", "x", 2, 100)));
        one.put(List.of(record("a", "x", 3, 80)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
    }

    @Test
    void keepADeletionInMindThatTheContextBrokerCannotTellOf() {
        one.put(List.of(record("a", "x", 1, 50)));
        one.put(List.of(deletion("a", 90)));
        one.put(List.of(record("a", "x", 3, 80)));

        assertThat(broker.entities).isEmpty();
    }
}
