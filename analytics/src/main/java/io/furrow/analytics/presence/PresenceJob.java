package io.furrow.analytics.presence;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.field.RecognizeFields;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
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
        assemble(options).execute(options.jobName());
    }

    /** The job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(PresenceOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Reported changes")
                .uid("reported-changes");

        define(new Inputs(records, FieldInput.of(env, options, options.fields())), options)
                .sinkTo(KafkaEnds.sink(options))
                .uid("write-topics")
                .name("Write passages, late positions and dead letters");
        return env;
    }

    /** Passages, late positions and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, PresenceOptions options) {
        String output = options.output();
        String lateOutput = options.lateOutput();

        SingleOutputStreamOperator<PresenceFix> fixes =
                in.records().process(new LocateDevices()).uid("locate-devices").name("Locate devices");

        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .records()
                .process(new RecognizeFields("presence"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<Passage> passages = fixes.keyBy(PresenceFix::key)
                .connect(fields.broadcast(KnownFields.BROADCAST))
                .process(new FollowDevices(options.rules(), in.fields().atStart()))
                .uid("follow-devices")
                .name("Follow devices through fields");

        DataStream<TopicRecord> results = passages.map(passage -> PresenceRecord.of(passage, output))
                .uid("describe-passages")
                .name("Describe passages as entities");

        DataStream<TopicRecord> late = passages.getSideOutput(FollowDevices.LATE)
                .map(fix -> PresenceRecord.late(fix, lateOutput))
                .uid("describe-late-positions")
                .name("Describe late positions as entities");

        return results.union(late, fixes.getSideOutput(DeadLetters.TAG), fields.getSideOutput(DeadLetters.TAG));
    }
}
