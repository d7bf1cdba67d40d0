package io.furrow.flink.kafka;

import org.apache.flink.streaming.api.datastream.DataStream;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;

/** The output of a job for records that name their topic; tests replace it. */
public interface KafkaOutput {
    /** @param name of the stream, in kebab-case; {@code write-<name>} is the sink's uid */
    void write(String name, DataStream<TopicRecord> records);

    /** Writes all output of a job through one sink of the uid {@code write-topics}; else as {@link #of}. */
    static void writeAll(DataStream<TopicRecord> records, JobOptions options, TopicOptions.Settings topics) {
        records.map(new EnsureTopics(options, topics))
                .uid("ensure-topics")
                .name("Ensure topics")
                .sinkTo(KafkaConnectors.sink(options))
                .uid("write-topics")
                .name("Write topics");
    }

    /** Kafka under the job's delivery guarantee; topics are created when needed. */
    static KafkaOutput of(JobOptions options, TopicOptions.Settings topics) {
        return (name, records) -> records.map(new EnsureTopics(options, topics))
                .uid("ensure-topics-of-" + name)
                .name("Ensure topics of " + name.replace('-', ' '))
                .sinkTo(KafkaConnectors.sink(options, name))
                .uid("write-" + name)
                .name("Write " + name.replace('-', ' '));
    }
}
