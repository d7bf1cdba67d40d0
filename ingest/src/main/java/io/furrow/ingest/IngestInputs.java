package io.furrow.ingest;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaTopicSnapshot;
import io.furrow.flink.kafka.TopicNames;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.AdvanceIdleInput;
import io.furrow.model.topic.Topics;

/**
 * The inputs of the job.
 *
 * @param records reported events, as on {@code data.raw}
 * @param devices the records of {@code service.devices}
 * @param devicesAtStart devices that exist before the first event
 * @param latestAtStart the content of {@code data.latest} before the first event
 * @param domains those of the control plane
 * @param missions those of the control plane
 * @param topics existing topics
 */
record IngestInputs(
        DataStream<TopicRecord> records,
        DataStream<TopicRecord> devices,
        TopicSnapshot devicesAtStart,
        TopicSnapshot latestAtStart,
        TopicSnapshot domains,
        TopicSnapshot missions,
        TopicNames topics) {
    /** The topics of the options. */
    static IngestInputs ofKafka(StreamExecutionEnvironment env, IngestOptions options) {
        DataStream<TopicRecord> records = AdvanceIdleInput.of(
                env.fromSource(
                                KafkaConnectors.source(options),
                                KafkaConnectors.watermarks(options),
                                "Read reported events")
                        .uid("read-events"),
                options);

        DataStream<TopicRecord> devices = env.fromSource(
                        KafkaConnectors.wholeTopic(options, options.devices()),
                        KafkaConnectors.alwaysIdle(),
                        "Read devices")
                .uid("read-devices")
                .setParallelism(1);

        return new IngestInputs(
                records,
                devices,
                new KafkaTopicSnapshot(options, options.devices()),
                new KafkaTopicSnapshot(options, Topics.LATEST),
                new KafkaTopicSnapshot(options, Topics.DOMAINS),
                new KafkaTopicSnapshot(options, Topics.MISSIONS),
                TopicNames.ofKafka(options));
    }
}
