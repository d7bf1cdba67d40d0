package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.function.UnaryOperator;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.AfterBroadcast;
import io.furrow.analytics.EachEvent;
import io.furrow.analytics.Replayed;
import io.furrow.analytics.TestEnvironment;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.device.DeviceInput;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** The job {@code collision} over a few reports of devices on the equator. */
public final class ReportedRun {
    static final long START = 1_700_000_000_000L;

    /** A laser on the robot r1; until the test's start it was on r2. */
    private static final TopicSnapshot DEVICES = () -> List.of(
            device(new DeviceVersion("l1", "farm", "/north", "", "", 0, null, 1, "r2")),
            device(new DeviceVersion("l1", "farm", "/north", "", "", START, null, 2, "r1")));

    private static final int MORE_THAN_ANY_TEST_WRITES = 10_000;

    private ReportedRun() {}

    static List<TopicRecord> run(CollisionOptions options, TopicRecord... records) throws Exception {
        return run(options, reports -> reports, records);
    }

    /** Where it matters which position is late. */
    static List<TopicRecord> runAfterDevices(
            CollisionOptions options, AfterBroadcast.Metrics metrics, TopicRecord... records) throws Exception {
        List<TopicRecord> all = new ArrayList<>(List.of(record("the first", AfterBroadcast.FIRST - START, null)));
        all.addAll(Arrays.asList(records));
        var after = new AfterBroadcast("Assign carriers", options.parallelism().orElse(2), metrics);
        return run(
                options,
                reports -> reports.filter(after).setParallelism(1).uid("after-devices"),
                all.toArray(TopicRecord[]::new));
    }

    private static List<TopicRecord> run(
            CollisionOptions options, UnaryOperator<DataStream<TopicRecord>> held, TopicRecord... records)
            throws Exception {
        StreamExecutionEnvironment env = TestEnvironment.of(options);
        env.setParallelism(options.parallelism().orElse(2));
        DataStream<TopicRecord> source = env.fromData(Arrays.asList(records))
                .setParallelism(1)
                .uid("records")
                .assignTimestampsAndWatermarks(watermarks(options))
                .setParallelism(1)
                .uid("timestamps");
        DataStream<TopicRecord> devices = env.fromData(DEVICES.read(), TypeInformation.of(TopicRecord.class))
                .uid("read-devices")
                .setParallelism(1);
        List<TopicRecord> written = CollisionJob.define(
                        new CollisionJob.Inputs(held.apply(source), new DeviceInput(devices, DEVICES)), options)
                .executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
        written.sort(Comparator.comparingLong(TopicRecord::timestamp));
        return written;
    }

    private static WatermarkStrategy<TopicRecord> watermarks(CollisionOptions options) {
        return options.inputTopics().replay().isPresent()
                ? Replayed.watermarks(options)
                : WatermarkStrategy.<TopicRecord>forGenerator(context -> new EachEvent<>(2000))
                        .withTimestampAssigner((record, ignored) -> record.timestamp());
    }

    private static TopicRecord device(DeviceVersion version) {
        return new TopicRecord(
                Topics.DEVICES,
                0,
                version.sequence(),
                version.from(),
                version.key().getBytes(UTF_8),
                version.toBytes(),
                Map.of());
    }

    public static CollisionOptions options(String... args) {
        CollisionOptions options = new CollisionOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    /** So many meters east of a place on the equator. */
    static TopicRecord robot(String id, double east, long time) {
        EntityBuilder robot = Entity.builder(id, "ROBOT").text("Mission", "hoeing");
        return record(id, time, text(placed(robot, east)));
    }

    static EntityBuilder placed(EntityBuilder entity, double east) {
        PositionFix place = Fixes.east("", east, 0);
        return entity.number("Latitude", place.latitude()).number("Longitude", place.longitude());
    }

    static String text(EntityBuilder entity) {
        return new String(entity.build().toBytes(), UTF_8);
    }

    static TopicRecord record(String key, long time, String value) {
        byte[] bytes = value == null ? null : value.getBytes(UTF_8);
        Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/north");
        return new TopicRecord("data.raw", 0, 7, START + time, key.getBytes(UTF_8), bytes, headers);
    }

    static Entity entity(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (io.furrow.model.ngsi.UnreadableException e) {
            throw new AssertionError("what the job wrote is an entity", e);
        }
    }
}
