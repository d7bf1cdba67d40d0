package io.furrow.analytics.field;

import java.util.List;
import java.util.Optional;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.JobOptions;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaTopicAtStart;
import io.furrow.flink.TopicAtStart;
import io.furrow.flink.TopicRecord;
import io.furrow.model.field.FieldVersion;

/**
 * How a job learns of the fields.
 *
 * @param records of {@code service.fields}, from its beginning and all that come
 * @param atStart those that are known before the first event
 */
public record FieldInput(DataStream<TopicRecord> records, TopicAtStart atStart) {
    /** The fields of the file or of the topic that the options name. */
    public static FieldInput of(StreamExecutionEnvironment env, JobOptions job, FieldOptions options) {
        Optional<List<FieldVersion>> file = options.file();
        if (file.isPresent()) {
            return of(env, file.get());
        }
        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.wholeTopic(job, options.topic()), KafkaEnds.noHindrance(), "Read fields")
                .uid("read-fields")
                .setParallelism(1);
        return new FieldInput(records, new KafkaTopicAtStart(job, options.topic()));
    }

    /** Fields that never change. */
    private static FieldInput of(StreamExecutionEnvironment env, List<FieldVersion> fields) {
        FieldsAtStart atStart = new FieldsAtStart(fields);
        DataStream<TopicRecord> records = env.fromData(atStart.read(), TypeInformation.of(TopicRecord.class))
                .uid("read-fields")
                .name("Read fields")
                .setParallelism(1);
        return new FieldInput(records, atStart);
    }
}
