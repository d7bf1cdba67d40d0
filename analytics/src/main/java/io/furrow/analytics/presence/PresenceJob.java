package io.furrow.analytics.presence;

import java.util.List;
import java.util.Set;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.clock.ClockStage;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.field.RecognizeFields;
import io.furrow.flink.AheadLimit;
import io.furrow.flink.BroadcastLatenessOperator;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaInput;
import io.furrow.flink.KafkaOutput;
import io.furrow.flink.Receipt;
import io.furrow.flink.TopicRecord;

/** The job {@code presence}: which device entered and left which field, and how long it stayed. */
public final class PresenceJob {
    /**
     * What comes in.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, FieldInput fields) {}

    private PresenceJob() {}

    /** Runs the job until it ends, which it does not by itself. */
    public static void run(PresenceOptions options) throws Exception {
        assemble(options).execute();
    }

    /** The job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(PresenceOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = KafkaInput.reportedChanges(env, options, options.maxDrift());

        KafkaOutput.writeAll(
                define(new Inputs(records, FieldInput.of(env, options, options.fields())), options),
                options,
                options.topics().settings(Set.of()));
        return env;
    }

    /** Passages, late positions, what is wrong with clocks, and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, PresenceOptions options) {
        if (!options.clockSettings().correct()) {
            return follow(in, options);
        }
        SingleOutputStreamOperator<TopicRecord> corrected = ClockStage.correct(in.records(), Receipt.of(options));
        return follow(new Inputs(corrected, in.fields()), options)
                .union(clocks(options).offsets(corrected));
    }

    private static DataStream<TopicRecord> follow(Inputs in, PresenceOptions options) {
        String output = options.output();
        String lateOutput = options.lateOutput();

        SingleOutputStreamOperator<PresenceFix> fixes = in.records()
                .process(new LocateDevices(AheadLimit.of(options)))
                .uid("locate-devices")
                .name("Locate devices");

        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .recordsBeside(in.records())
                .process(new RecognizeFields("presence"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<Passage> passages = fixes.keyBy(PresenceFix::key)
                .connect(fields.broadcast())
                .transform(
                        "Follow devices through fields",
                        TypeInformation.of(Passage.class),
                        new BroadcastLatenessOperator<>(
                                new FollowDevices(options.rules(), in.fields().atStart()),
                                List.of(KnownFields.BROADCAST)))
                .uid("follow-devices");

        DataStream<TopicRecord> results = passages.map(passage -> PresenceRecord.of(passage, output))
                .uid("describe-passages")
                .name("Describe passages as entities");

        DataStream<TopicRecord> late = passages.getSideOutput(FollowDevices.LATE)
                .map(fix -> PresenceRecord.late(fix, lateOutput))
                .uid("describe-late-positions")
                .name("Describe late positions as entities");

        DataStream<TopicRecord> behind = clocks(options).watch(passages.getSideOutput(FollowDevices.LAGGING));

        return results.union(late, behind, fixes.getSideOutput(DeadLetters.TAG), fields.getSideOutput(DeadLetters.TAG));
    }

    private static ClockStage clocks(PresenceOptions options) {
        return new ClockStage("presence", options.clockSettings());
    }
}
