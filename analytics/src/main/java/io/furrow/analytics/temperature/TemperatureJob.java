package io.furrow.analytics.temperature;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.windowing.assigners.SlidingEventTimeWindows;
import org.apache.flink.streaming.api.windowing.assigners.TumblingEventTimeWindows;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.KnownFields;
import io.furrow.analytics.field.RecognizeFields;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.PassOnce;
import io.furrow.flink.TopicRecord;

/** The job {@code temperature}: the average temperature of each field in event-time windows, one entity per field and window. */
public final class TemperatureJob {
    private static final OutputTag<FieldReading> LATE = new OutputTag<>("late-readings") {
        private static final long serialVersionUID = 1L;
    };

    /**
     * What comes in.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, FieldInput fields) {}

    private TemperatureJob() {}

    /** Runs the job until it ends, which it does not by itself. */
    public static void run(TemperatureOptions options) throws Exception {
        assemble(options).execute(options.jobName());
    }

    /** The job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(TemperatureOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Reported changes")
                .uid("reported-changes");

        define(new Inputs(records, FieldInput.of(env, options, options.fields())), options)
                .sinkTo(KafkaEnds.sink(options))
                .uid("write-topics")
                .name("Write results, late and dead records");
        return env;
    }

    /** Results, late readings and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, TemperatureOptions options) {
        SingleOutputStreamOperator<Reading> readings = in.records()
                .process(new ReadReadings(options.attribute()))
                .uid("read-readings")
                .name("Read readings");

        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .records()
                .process(new RecognizeFields("temperature"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<FieldReading> fieldReadings = readings.keyBy(Reading::deviceIdentity)
                .process(new PassOnce<>(options.repeatWindow(), Reading::eventId))
                .returns(Reading.class)
                .uid("pass-once")
                .name("Let each event pass once")
                .connect(fields.broadcast(KnownFields.BROADCAST))
                .process(new AssignFields(in.fields().atStart()))
                .uid("assign-fields")
                .name("Assign readings to fields");

        SingleOutputStreamOperator<DeviceVote> votes = fieldReadings
                .keyBy(FieldReading::voter)
                .window(SlidingEventTimeWindows.of(options.window(), options.slide()))
                .allowedLateness(options.allowedLateness())
                .sideOutputLateData(LATE)
                .aggregate(new CollectReadings(), new CastVote())
                .uid("cast-votes")
                .name("Cast one vote per device");

        // A vote is stamped with the last instant of its window: windows of one slide keep those of each window
        // together.
        SingleOutputStreamOperator<TopicRecord> results = votes.keyBy(DeviceVote::fieldIdentity)
                .window(TumblingEventTimeWindows.of(options.slide()))
                .allowedLateness(options.allowedLateness())
                .apply(new AverageVotes(options.output(), options.madFloor()))
                .uid("average-votes")
                .name("Average the votes of each field");

        SingleOutputStreamOperator<TopicRecord> late = votes.getSideOutput(LATE)
                .map(new NameLateWindow(options.lateOutput(), options.window(), options.slide()))
                .uid("name-late-window")
                .name("Name the window of late readings");

        return results.union(late, readings.getSideOutput(DeadLetters.TAG), fields.getSideOutput(DeadLetters.TAG));
    }
}
