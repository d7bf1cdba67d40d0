package io.furrow.analytics.job;

import java.util.function.BiFunction;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.kafka.KafkaInput;
import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.record.TopicRecord;

/** Connects an analytics job with its Kafka topics. */
public final class AnalyticsJob {
    private AnalyticsJob() {}

    /**
     * Returns the job, ready to be executed.
     *
     * @param definition from entities with event time as their timestamp to records that name their topic
     */
    public static StreamExecutionEnvironment assemble(
            AnalyticsOptions options,
            BiFunction<StreamExecutionEnvironment, DataStream<TopicRecord>, DataStream<TopicRecord>> definition) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        DataStream<TopicRecord> records = KafkaInput.reportedChanges(env, options, options.maxDrift());
        KafkaOutput.writeAll(
                definition.apply(env, records), options, options.topics().settings(options.compacted()));
        return env;
    }
}
