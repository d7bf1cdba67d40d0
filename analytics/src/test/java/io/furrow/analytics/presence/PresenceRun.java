package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.AfterBroadcast;
import io.furrow.analytics.EachEvent;
import io.furrow.analytics.Replayed;
import io.furrow.analytics.TestEnvironment;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** The job {@code presence} over a few reports of devices. */
final class PresenceRun {
    private static final int MORE_THAN_ANY_TEST_WRITES = 10_000;

    private PresenceRun() {}

    static List<TopicRecord> run(PresenceOptions options, List<Plot> plots, TopicRecord... records) throws Exception {
        StreamExecutionEnvironment env = TestEnvironment.of(options);
        env.setBufferTimeout(0); // what was sent first is there first
        env.setParallelism(options.parallelism().orElse(2));
        List<TopicRecord> all = new ArrayList<>(List.of(record("the first", AfterBroadcast.FIRST, null)));
        all.addAll(Arrays.asList(records));
        DataStream<TopicRecord> source = env.fromData(all)
                .setParallelism(1)
                .uid("records")
                .assignTimestampsAndWatermarks(watermarks(options))
                .setParallelism(1)
                .uid("timestamps")
                .filter(new AfterBroadcast(
                        "Track presence in fields", options.parallelism().orElse(2), () -> PresenceJobTest.METRICS))
                .setParallelism(1)
                .uid("after-fields");
        ArrayList<Plot> known = new ArrayList<>(plots);
        DataStream<TopicRecord> versions = env.fromData(records(known))
                .setParallelism(1)
                .uid("fields")
                .assignTimestampsAndWatermarks(WatermarkStrategy.forGenerator(context -> new NoHindrance()))
                .setParallelism(1)
                .uid("no-hindrance");
        PresenceJob.Inputs in = new PresenceJob.Inputs(source, new FieldInput(versions, () -> records(known)));
        List<TopicRecord> written = PresenceJob.define(in, options).executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
        written.sort(Comparator.comparingLong(TopicRecord::timestamp));
        return written;
    }

    static WatermarkStrategy<TopicRecord> watermarks(PresenceOptions options) {
        return options.inputTopics().replay().isPresent()
                ? Replayed.watermarks(options)
                : WatermarkStrategy.<TopicRecord>forGenerator(context -> new EachEvent<>(Story.BOUND))
                        .withTimestampAssigner((record, ignored) -> record.timestamp());
    }

    static List<TopicRecord> records(List<Plot> plots) {
        List<TopicRecord> records = new ArrayList<>();
        plots.forEach(plot -> records.add(plot.record(records.size())));
        return records;
    }

    private static final class NoHindrance implements WatermarkGenerator<TopicRecord> {
        @Override
        public void onEvent(TopicRecord event, long time, WatermarkOutput output) {
            output.emitWatermark(new Watermark(Long.MAX_VALUE - 1));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }

    static PresenceOptions options(String... args) {
        PresenceOptions options = new PresenceOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    static TopicRecord report(PositionFix fix) {
        Entity entity = Entity.builder(fix.id(), "ROBOT")
                .text("Mission", "hoeing")
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .build();
        return record(fix.id(), fix.time(), new String(entity.toBytes(), UTF_8));
    }

    static TopicRecord record(String key, long time, String value) {
        byte[] bytes = value == null ? null : value.getBytes(UTF_8);
        Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
        return new TopicRecord("data.raw", 0, 7, time, key.getBytes(UTF_8), bytes, headers);
    }

    /** As {@link PresenceOracle#line}. */
    static String line(TopicRecord record) {
        Entity entity = entity(record);
        return "data.raw|farm|/|%s %s %s at %d told %d from %s,%s %s since %d"
                .formatted(
                        entity.text("device").orElseThrow(),
                        entity.text("field").orElseThrow(),
                        entity.text("phase").orElseThrow(),
                        entity.number("time").orElseThrow().longValue(),
                        record.timestamp(),
                        entity.number("Longitude").orElseThrow(),
                        entity.number("Latitude").orElseThrow(),
                        entity.text("cause").orElseThrow(),
                        entity.number("startTime").orElseThrow().longValue());
    }

    static Entity entity(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new AssertionError("what the job wrote is an entity", e);
        }
    }
}
