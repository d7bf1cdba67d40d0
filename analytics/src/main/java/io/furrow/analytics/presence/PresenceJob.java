package io.furrow.analytics.presence;

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
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.position.ReadPositions;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;
import io.furrow.flink.time.ClockSkewLimit;

/** The job {@code presence}: detects which device entered and left which field, and how long it stayed. */
public final class PresenceJob {
    /**
     * The inputs of the job.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, FieldInput fields) {}

    private PresenceJob() {}

    /** Returns the job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(PresenceOptions options) {
        return AnalyticsJob.assemble(
                options,
                (env, records) -> define(new Inputs(records, FieldInput.of(env, options, options.fields())), options));
    }

    /** Returns transitions, late positions, clock reports and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, PresenceOptions options) {
        if (!options.clockSettings().correct()) {
            return follow(in, options);
        }
        SingleOutputStreamOperator<TopicRecord> corrected = clocks(options).correct(in.records());
        return follow(new Inputs(corrected, in.fields()), options)
                .union(clocks(options).offsets(corrected));
    }

    private static DataStream<TopicRecord> follow(Inputs in, PresenceOptions options) {
        String output = options.output();
        String lateOutput = options.lateOutput();

        SingleOutputStreamOperator<PositionFix> fixes = in.records()
                .process(new ReadPositions("presence", ClockSkewLimit.of(options)))
                .uid("read-positions")
                .name("Read positions");

        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .recordsBeside(in.records())
                .process(new ParseFields("presence"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<PresenceTransition> passages = fixes.keyBy(PositionFix::key)
                .connect(fields.broadcast())
                .transform(
                        "Track presence in fields",
                        TypeInformation.of(PresenceTransition.class),
                        new BroadcastLatenessOperator<>(
                                new TrackPresence(options.rules(), in.fields().atStart()),
                                List.of(FieldVersions.BROADCAST)))
                .uid("track-presence");

        DataStream<TopicRecord> results = passages.map(passage -> PresenceRecord.of(passage, output))
                .uid("describe-transitions")
                .name("Describe transitions as entities");

        DataStream<TopicRecord> late = passages.getSideOutput(TrackPresence.LATE)
                .map(fix -> PresenceRecord.late(fix, lateOutput))
                .uid("describe-late-positions")
                .name("Describe late positions as entities");

        DataStream<TopicRecord> behind = clocks(options).watch(passages.getSideOutput(TrackPresence.LAGGING));

        return results.union(
                late,
                behind,
                clocks(options).delays(in.records()),
                fixes.getSideOutput(DeadLetters.TAG),
                fields.getSideOutput(DeadLetters.TAG));
    }

    private static ClockStage clocks(PresenceOptions options) {
        return new ClockStage("presence", options);
    }
}
