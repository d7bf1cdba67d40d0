package io.furrow.ingest.normalise;

import java.util.Set;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaOutput;
import io.furrow.flink.TopicRecord;

/** Makes of each native notification the records that the NGSI source would make; what cannot be read, dead letters. */
public final class NormaliseJob {
    private NormaliseJob() {}

    /** The whole job on Kafka, ready to be executed. */
    public static StreamExecutionEnvironment assemble(NormaliseOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> notifications = env.fromSource(
                        KafkaEnds.source(options), WatermarkStrategy.noWatermarks(), "Read notifications")
                .uid("read-notifications");

        define(notifications, KafkaOutput.of(options, options.topics().settings(Set.of())), options);

        return env;
    }

    /** The pipeline: no state, so that the order of a partition is that of the events. */
    static void define(DataStream<TopicRecord> notifications, KafkaOutput kafka, NormaliseOptions options) {
        SingleOutputStreamOperator<TopicRecord> events = notifications
                .process(new NormaliseNotifications(options.settings()))
                .uid("normalise-notifications")
                .name("Normalise notifications");

        kafka.write("events", events);
        kafka.write("dead-letters", events.getSideOutput(DeadLetters.TAG));
    }
}
