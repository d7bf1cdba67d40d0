package io.furrow.connect.sink;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

/** What a task does where another one may write the same entity. */
class TwoTasksTest {
    private final FakeContextBroker broker = new FakeContextBroker();
    private final NgsiSinkTask one = started(0);
    private final NgsiSinkTask other = started(1);

    @AfterEach
    void stop() {
        one.stop();
        other.stop();
        broker.close();
    }

    @Test
    void keepTheNewestValueBecauseEachReadsAgainWhatIsTooOld() {
        one.put(List.of(record("a", 1, 50)));
        other.put(List.of(record("a", 2, 100)));
        one.put(List.of(record("a", 3, 80)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
    }

    @Test
    void keepADeletionInMindThatTheContextBrokerCannotTellOf() {
        one.put(List.of(record("a", 1, 50)));
        one.put(List.of(new SinkRecord("t", 0, null, "a", null, null, 0, 90L, TimestampType.CREATE_TIME)));
        one.put(List.of(record("a", 3, 80)));

        assertThat(broker.entities).isEmpty();
    }

    private NgsiSinkTask started(int index) {
        NgsiSinkTask task = new NgsiSinkTask();
        task.initialize(new FakeSinkContext(true));
        task.start(new HashMap<>(Map.of(
                "context.broker.url", broker.url().toString(),
                "delete.on.null", "true",
                "known.max.age.ms", "0",
                "task.index", Integer.toString(index))));
        return task;
    }

    private static SinkRecord record(String id, long value, long time) {
        byte[] entity = Entity.builder(id, "T").integer("x", value).build().toBytes();
        return new SinkRecord("t", 0, null, id, null, entity, 0, time, TimestampType.CREATE_TIME);
    }
}
