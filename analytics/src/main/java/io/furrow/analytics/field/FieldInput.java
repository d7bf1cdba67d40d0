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
 * The fields as input of a job.
 *
 * @param topic {@code service.fields} from its beginning, unbounded; empty for fields that never change
 * @param atStart fields that exist before the first event
 */
public record FieldInput(Optional<DataStream<TopicRecord>> topic, TopicSnapshot atStart) {
    /** The fields of a topic that is read beside the events. */
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
     * The records of the fields, for an operator that joins them with the events. For fields that never change it is an empty
     * stream with the event time of the events: a separate source would end, and in a restored job an ended source moves event
     * time to its end as soon as the events are idle, even with a backlog.
     */
    public DataStream<TopicRecord> recordsBeside(DataStream<TopicRecord> events) {
        return topic.orElseGet(() -> events.filter(event -> false)
                .uid("no-changes-of-fields")
                .name("Fields never change")
                // chained at one parallelism only, an unaligned checkpoint could not be restored at another
                .rebalance());
    }
}
