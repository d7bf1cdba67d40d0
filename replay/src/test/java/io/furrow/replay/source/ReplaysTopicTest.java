package io.furrow.replay.source;

import java.io.IOException;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class ReplaysTopicTest {
    /** A snapshot that passes records only one by one. */
    private record Statuses(List<TopicRecord> records) implements TopicSnapshot {
        @Override
        public List<TopicRecord> read() {
            throw new AssertionError("reads all statuses into memory");
        }

        @Override
        public <E extends Exception> void forEach(Taker<E> taker) throws E {
            for (TopicRecord record : records) {
                taker.take(record);
            }
        }
    }

    @Test
    void readsTheNewestStatusOfEachReplayThatWasNotDeleted() throws IOException {
        Statuses statuses = new Statuses(List.of(
                status("a", 1),
                status("b", 1),
                status("a", 2),
                record("broken", new byte[] {'{'}),
                status("b", 2),
                record("b", null)));

        assertThat(ReplaysTopic.newest(statuses))
                .containsExactly(
                        new DesiredReplays.ReportedStatus("a", new ReplayStatus(2, State.RUNNING, null, true, null)));
    }

    private static TopicRecord status(String replay, long sequence) {
        return record(replay, new ReplayStatus(sequence, State.RUNNING, null, false, null).toBytes());
    }

    private static TopicRecord record(String replay, byte[] value) {
        return TopicRecord.of(Topics.REPLAYS_STATUS, 0, replay, value, Map.of());
    }
}
