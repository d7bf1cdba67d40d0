package io.furrow.ingest;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.streaming.api.datastream.DataStream;

import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.record.TopicRecord;

/** What a job would write to Kafka, collected. */
public final class CollectedOutput implements KafkaOutput {
    private static final int MORE_THAN_ANY_TEST_WRITES = 100_000;

    private final List<DataStream<TopicRecord>> streams = new ArrayList<>();

    @Override
    public void write(String name, DataStream<TopicRecord> records) {
        streams.add(records);
    }

    /** All streams together. */
    @SuppressWarnings({"unchecked", "rawtypes"}) // the array that union takes
    public DataStream<TopicRecord> all() {
        DataStream<TopicRecord>[] others = streams.subList(1, streams.size()).toArray(DataStream[]::new);
        return streams.get(0).union(others);
    }

    /** Runs the job to its end. */
    public List<TopicRecord> run() throws Exception {
        return all().executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
    }
}
