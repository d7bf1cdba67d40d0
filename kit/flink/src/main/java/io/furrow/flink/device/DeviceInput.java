package io.furrow.flink.device;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaTopicSnapshot;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;

/**
 * The devices as input of a job.
 *
 * @param records of {@code service.devices} from its beginning, unbounded
 * @param atStart devices that exist before the first event
 */
public record DeviceInput(DataStream<TopicRecord> records, TopicSnapshot atStart) {
    /** The devices of a topic, which need not exist. */
    public static DeviceInput of(StreamExecutionEnvironment env, JobOptions job, String topic) {
        DataStream<TopicRecord> records = env.fromSource(
                        KafkaConnectors.wholeTopic(job, topic), KafkaConnectors.alwaysIdle(), "Read devices")
                .uid("read-devices")
                .setParallelism(1);
        return new DeviceInput(records, new KafkaTopicSnapshot(job, topic));
    }
}
