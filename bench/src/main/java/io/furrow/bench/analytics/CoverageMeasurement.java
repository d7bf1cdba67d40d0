package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.List;
import java.util.function.Consumer;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;

import io.furrow.analytics.coverage.BuildSwaths;
import io.furrow.analytics.coverage.CoverField;
import io.furrow.analytics.coverage.CoverageRules;
import io.furrow.analytics.coverage.Swath;
import io.furrow.analytics.coverage.WorkReport;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.analytics.load.SyntheticFields;
import io.furrow.bench.frame.CpuReading;
import io.furrow.bench.frame.Figures;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;
import io.furrow.model.position.Position;

/** Measures reports per second and core through the operators that compute worked areas, beside a job that only copies the reports. */
final class CoverageMeasurement {
    private static final int ROUNDS = 3;
    private static final int ROBOTS = 1_000;
    private static final double WIDTH = 2;
    /** Meters of a row, driven at 1 m/s. */
    private static final int ROW = 60;
    /** Rows of a robot until it begins again. */
    private static final int ROWS = 20;

    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);
    private static final CoverageRules RULES = new CoverageRules(
            Double.NaN, 0.1, 10, Duration.ofSeconds(10), 0.5, Duration.ofSeconds(10), Duration.ofDays(7));

    private final SyntheticFields fields;
    private final long reports;
    private final Consumer<String> progress;

    /** @param reports of each round */
    CoverageMeasurement(SyntheticFields fields, long reports, Consumer<String> progress) {
        this.fields = fields;
        this.reports = reports;
        this.progress = progress;
    }

    /** Runs alternating rounds, of which only the last counts; earlier ones warm up the JVM. */
    void run(Iterable<Integer> parallelisms, Figures figures) throws Exception {
        for (int parallelism : parallelisms) {
            double copied = 0;
            double seconds = 0;
            double cpuSeconds = 0;
            for (int round = 1; round <= ROUNDS; round++) {
                CpuReading begin = CpuReading.now();
                copy(parallelism);
                copied = CpuReading.now().seconds(begin);
                begin = CpuReading.now();
                cover(parallelism);
                CpuReading end = CpuReading.now();
                seconds = end.seconds(begin);
                cpuSeconds = end.cpuSeconds(begin);
                progress.accept("worked area on %d, round %d of %d".formatted(parallelism, round, ROUNDS));
            }
            figures.add(
                    "cores", parallelism,
                    "reports/s", reports / seconds,
                    "per core", reports / cpuSeconds,
                    "copies/s", reports / copied);
        }
    }

    private void copy(int parallelism) throws Exception {
        StreamExecutionEnvironment env = environment(parallelism);
        stream(env).keyBy(report -> report.fix().key()).map(report -> report).sinkTo(new DiscardingSink<>());
        env.execute();
    }

    private void cover(int parallelism) throws Exception {
        StreamExecutionEnvironment env = environment(parallelism);
        DataStream<TopicRecord> changes = env.fromData(
                fields.read(), TypeInformation.of(TopicRecord.class)); // its end does not hold back event time
        stream(env)
                .keyBy(report -> report.fix().key())
                .connect(changes.broadcast())
                .transform(
                        "BuildSwaths",
                        TypeInformation.of(Swath.class),
                        new BroadcastLatenessOperator<>(
                                new BuildSwaths(RULES, fields), List.of(FieldVersions.BROADCAST)))
                .keyBy(Swath::key)
                .process(new CoverField(RULES))
                .sinkTo(new DiscardingSink<>());
        env.execute();
    }

    private DataStream<WorkReport> stream(StreamExecutionEnvironment env) {
        SyntheticFields where = fields; // this object is not serialized with the job
        GeneratorFunction<Long, WorkReport> nth = n -> report(n % ROBOTS, n / ROBOTS, where.position(n % ROBOTS));
        WatermarkStrategy<WorkReport> marks = WatermarkStrategy.<WorkReport>forBoundedOutOfOrderness(
                        Duration.ofSeconds(1))
                .withTimestampAssigner((report, previous) -> report.time());
        return env.fromSource(
                new DataGeneratorSource<>(nth, reports, TypeInformation.of(WorkReport.class)), marks, "Reports");
    }

    /** A robot that drives rows side by side from a position to the east and north. */
    private static WorkReport report(long robot, long second, Position start) {
        long row = second / ROW % ROWS;
        long way = row % 2 == 0 ? second % ROW : ROW - second % ROW;
        double north = (row * WIDTH) / METERS_PER_DEGREE;
        double east = way / METERS_PER_DEGREE / Math.cos(Math.toRadians(start.latitude()));
        String id = "urn:ngsi-ld:Robot:" + robot;
        PositionFix fix = new PositionFix(
                "data.raw",
                "farm|/|Robot|" + id,
                id,
                "Robot",
                "m" + robot % 100,
                "",
                start.latitude() + north,
                start.longitude() + east,
                Double.NaN,
                Double.NaN,
                Fleet.START + second * 1000);
        return new WorkReport(fix, WIDTH, WorkReport.Work.ON);
    }

    private static StreamExecutionEnvironment environment(int parallelism) {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        return StreamExecutionEnvironment.createLocalEnvironment(parallelism, settings);
    }
}
