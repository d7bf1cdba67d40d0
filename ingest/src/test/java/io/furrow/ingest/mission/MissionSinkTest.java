package io.furrow.ingest.mission;

import java.time.Duration;
import java.util.concurrent.atomic.AtomicBoolean;

import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionSinkTest {
    @Test
    void closesWhatItOpenedWhereItCannotBegin() {
        AtomicBoolean closed = new AtomicBoolean();
        Sink<TopicRecord> deadLetters = new DiscardingSink<>() {
            @Override
            public SinkWriter<TopicRecord> createWriter(WriterInitContext context) {
                return new SinkWriter<>() {
                    @Override
                    public void write(TopicRecord record, Context where) {}

                    @Override
                    public void flush(boolean endOfInput) {}

                    @Override
                    public void close() {
                        closed.set(true);
                    }
                };
            }
        };
        MongoAccess access = new MongoAccess("no address", MongoAccess.Waits.of(Duration.ZERO));

        assertThatThrownBy(() -> new MissionSink(access, Retention.FOR_EVER, deadLetters).createWriter(null))
                .isInstanceOf(RuntimeException.class);
        assertThat(closed).isTrue();
    }
}
