package io.furrow.ingest.normalize;

import java.util.Set;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;

/**
 * The job {@code normalize}: translates native notifications into the records that the NGSI source would write;
 * unreadable ones become dead letters.
 */
public final class NormalizeJob {
    private NormalizeJob() {}

    /** Returns the whole job on Kafka, ready to be executed. */
    public static StreamExecutionEnvironment assemble(NormalizeOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> notifications = env.fromSource(
                        KafkaConnectors.source(options), WatermarkStrategy.noWatermarks(), "Read notifications")
                .uid("read-notifications");

        define(notifications, KafkaOutput.of(options, options.topics().settings(Set.of())), options);

        return env;
    }

    /** The pipeline; stateless, so that the order of a partition is preserved. */
    static void define(DataStream<TopicRecord> notifications, KafkaOutput kafka, NormalizeOptions options) {
        SingleOutputStreamOperator<TopicRecord> events = notifications
                .process(new NormalizeNotifications(options.settings()))
                .uid("normalize-notifications")
                .name("Normalize notifications");

        kafka.write("events", events);
        kafka.write("dead-letters", events.getSideOutput(DeadLetters.TAG));
    }
}
