package io.furrow.flink.restart;

import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;

import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.flink.record.TopicRecord;

/** A sink that keeps what the runs of a job wrote, at least once as a broker does. */
final class Written implements Sink<TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Queue<TopicRecord> RECORDS = new ConcurrentLinkedQueue<>();

    /** Forgets what was written before. */
    static void clear() {
        RECORDS.clear();
    }

    /** As if this had been written by a run before. */
    static void beginWith(List<TopicRecord> before) {
        RECORDS.clear();
        RECORDS.addAll(before);
    }

    static List<TopicRecord> records() {
        return List.copyOf(RECORDS);
    }

    @Override
    public SinkWriter<TopicRecord> createWriter(WriterInitContext context) {
        return new SinkWriter<>() {
            @Override
            public void write(TopicRecord record, Context unused) {
                RECORDS.add(record);
            }

            @Override
            public void flush(boolean endOfInput) {}

            @Override
            public void close() {}
        };
    }
}
