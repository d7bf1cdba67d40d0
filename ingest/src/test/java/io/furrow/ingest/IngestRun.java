package io.furrow.ingest;

import java.util.Arrays;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.TopicNames;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** The job {@code ingest} over records that a test has, at parallelism 2, to their end. */
final class IngestRun {
    private IngestRun() {}

    /** All that the job would write to Kafka. */
    static List<TopicRecord> of(IngestOptions options, FixedDevices devices, TopicRecord... records) throws Exception {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.setParallelism(2);
        DataStream<TopicRecord> source = env.fromData(Arrays.asList(records))
                .setParallelism(1)
                .uid("records")
                .assignTimestampsAndWatermarks(WatermarkStrategy.<TopicRecord>forMonotonousTimestamps()
                        .withTimestampAssigner((record, ignored) -> record.timestamp()))
                .uid("timestamps")
                .keyBy(record -> new String(record.key(), UTF_8)); // as a topic's partitions do
        DataStream<TopicRecord> deviceRecords = env.fromData(List.of(
                        new TopicRecord(Topics.DEVICES, 1, 0, 0, "|/|of-nobody".getBytes(UTF_8), null, Map.of())))
                .setParallelism(1)
                .uid("devices")
                .assignTimestampsAndWatermarks(KafkaConnectors.alwaysIdle())
                .uid("no-hindrance")
                .setParallelism(1);

        CollectedOutput out = new CollectedOutput();
        IngestJob.define(
                new IngestInputs(
                        source,
                        deviceRecords,
                        devices,
                        TopicSnapshot.NONE,
                        TopicSnapshot.NONE,
                        TopicSnapshot.NONE,
                        TopicNames.NONE),
                out,
                options);
        return out.run();
    }
}
