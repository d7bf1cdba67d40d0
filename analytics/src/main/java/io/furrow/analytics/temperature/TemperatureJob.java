package io.furrow.analytics.temperature;

import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.clock.ClockStage;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.field.ParseFields;
import io.furrow.analytics.job.AnalyticsJob;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.DeduplicateById;
import io.furrow.flink.time.KeyedLatenessOperator;
import io.furrow.flink.time.TimelessBroadcastOperator;

/** The job {@code temperature}: computes the average temperature of each field in event-time windows, one entity per field and window. */
public final class TemperatureJob {
    /**
     * The inputs of the job.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, FieldInput fields) {}

    private TemperatureJob() {}

    /** Returns the job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(TemperatureOptions options) {
        return AnalyticsJob.assemble(
                options,
                (env, records) -> define(new Inputs(records, FieldInput.of(env, options, options.fields())), options));
    }

    /** Returns results, late readings and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, TemperatureOptions options) {
        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .recordsBeside(in.records())
                .process(new ParseFields("temperature"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<Reading> readings = in.records()
                .process(new ReadReadings(options.attribute(), ClockSkewLimit.of(options)))
                .uid("read-readings")
                .name("Read readings");

        SingleOutputStreamOperator<FieldReading> fieldReadings = readings.keyBy(Reading::deviceIdentity)
                .transform(
                        "Deduplicate events by id",
                        TypeInformation.of(Reading.class),
                        new KeyedLatenessOperator<>(
                                new DeduplicateById<Reading>(options.repeatWindow(), Reading::eventId)))
                .uid("deduplicate-by-id")
                .connect(fields.broadcast())
                .transform(
                        "Assign readings to fields",
                        TypeInformation.of(FieldReading.class),
                        new TimelessBroadcastOperator<>(
                                new AssignFields(in.fields().atStart()), List.of(FieldVersions.BROADCAST)))
                .uid("assign-fields");

        SingleOutputStreamOperator<DeviceVote> votes = VoteStage.cast(fieldReadings, options);

        SingleOutputStreamOperator<FieldAverage> averages = VoteStage.average(votes, options);

        ResultEntity form = new ResultEntity(options.attribute(), options.output());
        DataStream<TopicRecord> described =
                averages.map(form::of).uid("describe-averages").name("Describe averages as entities");

        DataStream<TopicRecord> dead =
                readings.getSideOutput(DeadLetters.TAG).union(fields.getSideOutput(DeadLetters.TAG));
        return described.union(
                VoteStage.late(votes, options), new ClockStage("temperature", options).delays(in.records()), dead);
    }
}
