package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.collision.motion.MotionDetection;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.TopicRecord;
import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.DeviceInput;
import io.furrow.flink.device.ReadDevices;

/** The job {@code collision}: encounters of devices, from the first instant at which they are close to the last. */
public final class CollisionJob {
    /**
     * What comes in.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, DeviceInput devices) {}

    private CollisionJob() {}

    /** Runs the job until it ends, which it does not by itself. */
    public static void run(CollisionOptions options) throws Exception {
        assemble(options).execute(options.jobName());
    }

    /** The job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(CollisionOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        if (options.eager()) {
            JobEnvironment.hasten(env);
        }

        DataStream<TopicRecord> records = env.fromSource(
                        KafkaEnds.source(options), KafkaEnds.watermarks(options), "Reported changes")
                .uid("reported-changes");

        define(new Inputs(records, DeviceInput.of(env, options, options.devices())), options)
                .sinkTo(KafkaEnds.sink(options))
                .uid("write-topics")
                .name("Write encounters, late positions and dead letters");
        return env;
    }

    /**
     * @return encounters, late positions, crowded cells and dead letters; each record names its topic
     */
    static DataStream<TopicRecord> define(Inputs in, CollisionOptions options) {
        SingleOutputStreamOperator<PositionFix> read =
                in.records().process(new ReadPositions()).uid("read-positions").name("Read positions");

        SingleOutputStreamOperator<DeviceChange> devices = in.devices()
                .records()
                .process(new ReadDevices("collision"))
                .setParallelism(1) // a device's versions stay in order
                .uid("recognize-devices")
                .name("Recognize devices");

        SingleOutputStreamOperator<PositionFix> carried = read.keyBy(PositionFix::device)
                .connect(devices.broadcast(AssignCarriers.DEVICES))
                .process(new AssignCarriers(in.devices().atStart()))
                .uid("assign-carriers")
                .name("Assign carriers");
        // A device's positions stay where they are.
        KeyedStream<PositionFix, Device> fixes = DataStreamUtils.reinterpretAsKeyedStream(
                carried, PositionFix::device, TypeInformation.of(Device.class));

        DataStream<TopicRecord> results = results(
                        CollisionDetection.define(fixes, options.rules(), options.eager()), options)
                .union(read.getSideOutput(DeadLetters.TAG), devices.getSideOutput(DeadLetters.TAG));
        return options.motionRules().any() ? results.union(approaches(fixes, options)) : results;
    }

    private static DataStream<TopicRecord> results(CollisionDetection detection, CollisionOptions options) {
        String output = options.output();
        String lateOutput = options.lateOutput();
        String overflowOutput = options.overflowOutput();

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

        return encounters.union(late, overflows);
    }

    /** Beside the encounters, and only where asked for. */
    private static DataStream<TopicRecord> approaches(DataStream<PositionFix> fixes, CollisionOptions options) {
        String output = options.output();
        return MotionDetection.define(fixes, options.motionRules())
                .map(approach -> CollisionRecord.of(approach, output))
                .uid("describe-approaches")
                .name("Describe predictions and crossings as entities");
    }
}
