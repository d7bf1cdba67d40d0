package io.furrow.flink.device;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.JobOptions;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaTopicAtStart;
import io.furrow.flink.TopicAtStart;
import io.furrow.flink.TopicRecord;

/**
 * How a job learns of the devices.
 *
 * @param records of {@code service.devices}, from its beginning and all that come
 * @param atStart those that are known before the first event
 */
public record DeviceInput(DataStream<TopicRecord> records, TopicAtStart atStart) {
    /** The devices of a topic, which need not be there. */
    public static DeviceInput of(StreamExecutionEnvironment env, JobOptions job, String topic) {
        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.wholeTopic(job, topic), KafkaEnds.noHindrance(), "Read devices")
                .uid("read-devices")
                .setParallelism(1);
        return new DeviceInput(records, new KafkaTopicAtStart(job, topic));
    }
}
