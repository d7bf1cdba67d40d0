package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.AfterBroadcast;
import io.furrow.analytics.EachEvent;
import io.furrow.analytics.Replayed;
import io.furrow.analytics.TestEnvironment;
import io.furrow.analytics.coverage.CoverageOracle.Exact;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** The job {@code coverage} over a few reports of robots. */
final class CoverageRun {
    private static final int MORE_THAN_ANY_TEST_WRITES = 10_000;

    private CoverageRun() {}

    static List<TopicRecord> run(CoverageOptions options, List<TopicRecord> fields, TopicRecord... records)
            throws Exception {
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
                        "Build swaths", options.parallelism().orElse(2), () -> CoverageJobTest.METRICS))
                .setParallelism(1)
                .uid("after-fields");
        List<TopicRecord> written = CoverageJob.define(new CoverageJob.Inputs(source, fields(env, fields)), options)
                .executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
        written.sort(Comparator.comparingLong(TopicRecord::timestamp));
        return written;
    }

    /** Fields that exist at the start and stay. */
    static FieldInput fields(StreamExecutionEnvironment env, List<TopicRecord> fields) {
        DataStream<TopicRecord> versions = env.fromData(fields, TypeInformation.of(TopicRecord.class))
                .setParallelism(1)
                .uid("fields")
                .assignTimestampsAndWatermarks(KafkaConnectors.alwaysIdle())
                .setParallelism(1)
                .uid("no-hindrance");
        return new FieldInput(versions, new StoredFields(fields));
    }

    private static WatermarkStrategy<TopicRecord> watermarks(CoverageOptions options) {
        return options.inputTopics().replay().isPresent()
                ? Replayed.watermarks(options)
                : WatermarkStrategy.<TopicRecord>forGenerator(context -> new EachEvent<>(Drives.BOUND))
                        .withTimestampAssigner((record, ignored) -> record.timestamp());
    }

    static CoverageOptions options(String... args) {
        CoverageOptions options = new CoverageOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    static TopicRecord report(WorkReport report) {
        EntityBuilder entity = Entity.builder(report.fix().id(), "Robot")
                .text("Mission", report.fix().mission());
        if (report.isLocated()) {
            entity.number("Latitude", report.fix().latitude())
                    .number("Longitude", report.fix().longitude());
        }
        if (!Double.isNaN(report.width())) {
            entity.number("workingWidth", report.width());
        }
        if (report.work() != Work.UNKNOWN) {
            entity.bool("working", report.work() == Work.ON);
        }
        return record(report.fix().id(), report.time(), new String(entity.toBytes(), UTF_8));
    }

    static TopicRecord record(String key, long time, String value) {
        byte[] bytes = value == null ? null : value.getBytes(UTF_8);
        Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
        return new TopicRecord("data.raw", 0, 7, time, key.getBytes(UTF_8), bytes, headers);
    }

    static Entity entity(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new AssertionError("what the job wrote is an entity", e);
        }
    }

    /** As {@link #expected}. */
    static String line(TopicRecord record) {
        Entity entity = entity(record);
        double cell = entity.number("cell").orElseThrow();
        return "%s %s at %d: %s covered, %s overlapped, %s in gaps"
                .formatted(
                        entity.text("Mission").orElseThrow(),
                        entity.text("device").orElse("all"),
                        record.timestamp(),
                        cells(entity, "hectares", cell),
                        cells(entity, "overlapHectares", cell),
                        cells(entity, "gapHectares", cell));
    }

    private static String cells(Entity entity, String attribute, double cell) {
        return entity.number(attribute)
                .map(hectares -> Long.toString(Math.round(hectares * 10_000 / cell / cell)))
                .orElse("?");
    }

    /** What the definition says: a line for each report of each mission's coverage, of all robots and of each. */
    static List<String> expected(Drives drives, CoverageOptions options) throws Exception {
        CoverageRules rules = options.rules();
        FieldVersions fields = FieldVersions.read(drives.fields.atStart());
        CoverageOracle oracle =
                new CoverageOracle(fields.at("f", Drives.START).orElseThrow().area(), rules);
        List<Exact> all = oracle.swaths(drives.reports);
        List<String> lines = new ArrayList<>();
        for (String mission : new TreeSet<>(all.stream().map(Exact::mission).toList())) {
            List<Exact> ofMission = all.stream()
                    .filter(swath -> swath.mission().equals(mission))
                    .toList();
            addLines(mission + " all", ofMission, oracle, rules, lines);
            for (String robot :
                    new TreeSet<>(ofMission.stream().map(Exact::robot).toList())) {
                List<Exact> own = ofMission.stream()
                        .filter(swath -> swath.robot().equals(robot))
                        .toList();
                addLines(mission + " " + robot, own, oracle, rules, lines);
            }
        }
        lines.sort(null);
        return lines;
    }

    private static void addLines(
            String name, List<Exact> swaths, CoverageOracle oracle, CoverageRules rules, List<String> lines) {
        long every = rules.every().toMillis();
        TreeSet<Long> times = new TreeSet<>(swaths.stream()
                .map(swath -> (swath.time() + every - 1) / every * every)
                .toList());
        for (long time : times) {
            int[][] codes = oracle.codes(
                    swaths.stream().filter(swath -> swath.time() <= time).toList());
            long[] counts = new long[4];
            Arrays.stream(codes).flatMapToInt(Arrays::stream).forEach(code -> counts[code]++);
            lines.add("%s at %d: %d covered, %d overlapped, %s in gaps"
                    .formatted(
                            name,
                            time,
                            counts[1] + counts[2],
                            counts[2],
                            name.endsWith("all") ? Long.toString(counts[3]) : "?"));
        }
    }
}
