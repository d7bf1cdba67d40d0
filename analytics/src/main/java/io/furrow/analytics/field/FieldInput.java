package io.furrow.analytics.field;

import java.util.List;
import java.util.Optional;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaTopicSnapshot;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.field.FieldVersion;

/**
 * How a job learns of the fields.
 *
 * @param topic {@code service.fields}, from its beginning and all that come; empty for fields that never change
 * @param atStart those that are known before the first event
 */
public record FieldInput(Optional<DataStream<TopicRecord>> topic, TopicSnapshot atStart) {
    /** Fields of a topic that is read beside the events. */
    public FieldInput(DataStream<TopicRecord> topic, TopicSnapshot atStart) {
        this(Optional.of(topic), atStart);
    }

    /** The fields of the file or of the topic that the options name. */
    public static FieldInput of(StreamExecutionEnvironment env, JobOptions job, FieldOptions options) {
        Optional<List<FieldVersion>> file = options.file();
        if (file.isPresent()) {
            return new FieldInput(Optional.empty(), new InitialFields(file.get()));
        }
        DataStream<TopicRecord> records = env.fromSource(
                        KafkaConnectors.wholeTopic(job, options.topic()), KafkaConnectors.alwaysIdle(), "Read fields")
                .uid("read-fields")
                .setParallelism(1);
        return new FieldInput(records, new KafkaTopicSnapshot(job, options.topic()));
    }

    /**
     * The records of the fields, for an operator that joins them with the events. Fields that never change have none: a stream
     * without records whose event time is that of the events. A source of their own would end, and where a job is restored, a
     * source that has ended moves event time to its end as soon as the events are idle, whatever stands behind it.
     */
    public DataStream<TopicRecord> recordsBeside(DataStream<TopicRecord> events) {
        return topic.orElseGet(
                () -> events.filter(event -> false).uid("no-changes-of-fields").name("Fields never change"));
    }
}
