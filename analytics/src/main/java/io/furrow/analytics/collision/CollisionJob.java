package io.furrow.analytics.collision;

import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.clock.ClockStage;
import io.furrow.analytics.collision.grid.AssignCarriers;
import io.furrow.analytics.collision.motion.MotionDetection;
import io.furrow.analytics.job.AnalyticsJob;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.position.ReadPositions;
import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.DeviceInput;
import io.furrow.flink.device.ParseDevices;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.KeyedTimelessBroadcastOperator;

/** The job {@code collision}: detects encounters of devices, from the first instant at which they are close to the last. */
public final class CollisionJob {
    /**
     * The inputs of the job.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, DeviceInput devices) {}

    private CollisionJob() {}

    /** Returns the job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(CollisionOptions options) {
        return AnalyticsJob.assemble(
                options,
                (env, records) ->
                        define(new Inputs(records, DeviceInput.of(env, options, options.devices())), options));
    }

    /** @return encounters, late positions, crowded cells, clock reports and dead letters; each record names its topic */
    static DataStream<TopicRecord> define(Inputs in, CollisionOptions options) {
        if (!options.clockSettings().correct()) {
            return detect(in, options);
        }
        SingleOutputStreamOperator<TopicRecord> corrected = clocks(options).correct(in.records());
        return detect(new Inputs(corrected, in.devices()), options)
                .union(clocks(options).offsets(corrected));
    }

    private static DataStream<TopicRecord> detect(Inputs in, CollisionOptions options) {
        SingleOutputStreamOperator<PositionFix> read = in.records()
                .process(new ReadPositions("collision", ClockSkewLimit.of(options)))
                .uid("read-positions")
                .name("Read positions");

        SingleOutputStreamOperator<DeviceChange> devices = in.devices()
                .records()
                .process(new ParseDevices("collision"))
                .setParallelism(1) // a device's versions stay in order
                .uid("recognize-devices")
                .name("Recognize devices");

        SingleOutputStreamOperator<PositionFix> carried = read.keyBy(PositionFix::device)
                .connect(devices.broadcast())
                .transform(
                        "Assign carriers",
                        TypeInformation.of(PositionFix.class),
                        new KeyedTimelessBroadcastOperator<>(
                                new AssignCarriers(
                                        in.devices().atStart(),
                                        options.inputTopics().replay().isPresent()),
                                List.of(AssignCarriers.DEVICES)))
                .uid("assign-carriers");
        // A device's positions keep their partition.
        KeyedStream<PositionFix, Device> fixes = DataStreamUtils.reinterpretAsKeyedStream(
                carried, PositionFix::device, TypeInformation.of(Device.class));

        DataStream<TopicRecord> results = results(CollisionDetection.define(fixes, options.rules()), options)
                .union(
                        clocks(options).delays(in.records()),
                        read.getSideOutput(DeadLetters.TAG),
                        devices.getSideOutput(DeadLetters.TAG));
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

        return encounters.union(late, overflows, clocks(options).watch(detection.lagging()));
    }

    private static ClockStage clocks(CollisionOptions options) {
        return new ClockStage("collision", options);
    }

    /** In addition to the encounters, if enabled. */
    private static DataStream<TopicRecord> approaches(DataStream<PositionFix> fixes, CollisionOptions options) {
        String output = options.output();
        return MotionDetection.define(fixes, options.motionRules())
                .map(approach -> CollisionRecord.of(approach, output))
                .uid("describe-approaches")
                .name("Describe predictions and crossings as entities");
    }
}
