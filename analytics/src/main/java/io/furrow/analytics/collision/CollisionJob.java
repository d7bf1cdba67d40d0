package io.furrow.analytics.collision;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.TopicRecord;

/** The job {@code collision}: encounters of devices, from the first instant at which they are close to the last. */
public final class CollisionJob {
    private CollisionJob() {}

    /** Runs the job until it ends, which it does not by itself. */
    public static void run(CollisionOptions options) throws Exception {
        assemble(options).execute(options.jobName());
    }

    /** The job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(CollisionOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Reported changes")
                .uid("reported-changes");

        define(records, options)
                .sinkTo(KafkaEnds.sink(options))
                .uid("write-topics")
                .name("Write encounters, late positions and dead letters");
        return env;
    }

    /**
     * @param records entities with event time as their timestamp
     * @return encounters, late positions, crowded cells and dead letters; each record names its topic
     */
    static DataStream<TopicRecord> define(DataStream<TopicRecord> records, CollisionOptions options) {
        String output = options.output();
        String lateOutput = options.lateOutput();
        String overflowOutput = options.overflowOutput();

        SingleOutputStreamOperator<PositionFix> fixes =
                records.process(new ReadPositions()).uid("read-positions").name("Read positions");

        CollisionDetection detection = CollisionDetection.define(fixes, options.rules());

        DataStream<TopicRecord> encounters = detection
                .encounters()
                .map(encounter -> CollisionRecord.of(encounter, output))
                .uid("describe-encounters")
                .name("Describe encounters as entities");

        DataStream<TopicRecord> late = detection
                .late()
                .map(fix -> CollisionRecord.late(fix, lateOutput))
                .uid("describe-late-positions")
                .name("Describe late positions as entities");

        DataStream<TopicRecord> overflows = detection
                .overflows()
                .map(overflow -> CollisionRecord.overflow(overflow, overflowOutput))
                .uid("describe-overflows")
                .name("Describe crowded cells as entities");

        return encounters.union(late, overflows, fixes.getSideOutput(DeadLetters.TAG));
    }
}
