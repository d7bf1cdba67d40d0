package io.furrow.analytics.temperature;

import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;

import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.flink.record.TopicRecord;

/** A sink that keeps what a job in this JVM wrote. Each has a name of its own, because the job works on copies of it. */
final class Collected implements Sink<TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Map<String, Queue<TopicRecord>> BY_NAME = new ConcurrentHashMap<>();

    private final String name = java.util.UUID.randomUUID().toString();

    /** What was written so far, one subtask's records in order. */
    List<TopicRecord> records() {
        return List.copyOf(BY_NAME.getOrDefault(name, new ConcurrentLinkedQueue<>()));
    }

    @Override
    public SinkWriter<TopicRecord> createWriter(WriterInitContext context) {
        Queue<TopicRecord> records = BY_NAME.computeIfAbsent(name, unused -> new ConcurrentLinkedQueue<>());
        return new SinkWriter<>() {
            @Override
            public void write(TopicRecord record, Context unused) {
                records.add(record);
            }

            @Override
            public void flush(boolean endOfInput) {}

            @Override
            public void close() {}
        };
    }
}
