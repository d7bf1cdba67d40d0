package io.furrow.ingest;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.AdvanceQuietInput;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaTopicAtStart;
import io.furrow.flink.TopicAtStart;
import io.furrow.flink.TopicRecord;
import io.furrow.model.topic.Topics;

/**
 * What comes in.
 *
 * @param records reported events, as on {@code data.raw}
 * @param devices the records of {@code service.devices}
 * @param devicesAtStart those that are known before the first event
 * @param latestAtStart what {@code data.latest} holds before the first event
 */
record IngestInputs(
        DataStream<TopicRecord> records,
        DataStream<TopicRecord> devices,
        TopicAtStart devicesAtStart,
        TopicAtStart latestAtStart) {
    /** The topics that the options name. */
    static IngestInputs ofKafka(StreamExecutionEnvironment env, IngestOptions options) {
        DataStream<TopicRecord> records = AdvanceQuietInput.of(
                env.fromSource(KafkaEnds.source(options), KafkaEnds.watermarks(options), "Read reported events")
                        .uid("read-events"),
                options);

        DataStream<TopicRecord> devices = env.fromSource(
                        KafkaEnds.wholeTopic(options, options.devices()), KafkaEnds.noHindrance(), "Read devices")
                .uid("read-devices")
                .setParallelism(1);

        return new IngestInputs(
                records,
                devices,
                new KafkaTopicAtStart(options, options.devices()),
                new KafkaTopicAtStart(options, Topics.LATEST));
    }
}
