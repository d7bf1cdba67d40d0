package io.furrow.analytics.coverage;

import java.util.List;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.clock.ClockStage;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.field.ParseFields;
import io.furrow.analytics.job.AnalyticsJob;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;
import io.furrow.flink.time.ClockSkewLimit;

/** The job {@code coverage}: computes what robots have worked of each field, per mission. */
public final class CoverageJob {
    /**
     * The inputs of the job.
     *
     * @param records entities with event time as their timestamp
     */
    record Inputs(DataStream<TopicRecord> records, FieldInput fields) {}

    private CoverageJob() {}

    /** Returns the job between its Kafka topics, ready to be executed. */
    public static StreamExecutionEnvironment assemble(CoverageOptions options) {
        return AnalyticsJob.assemble(
                options,
                (env, records) -> define(new Inputs(records, FieldInput.of(env, options, options.fields())), options));
    }

    /** Returns coverages, layers, late positions, clock reports and dead letters; each record names its topic. */
    static DataStream<TopicRecord> define(Inputs in, CoverageOptions options) {
        if (!options.clockSettings().correct()) {
            return cover(in, options);
        }
        SingleOutputStreamOperator<TopicRecord> corrected = clocks(options).correct(in.records());
        return cover(new Inputs(corrected, in.fields()), options)
                .union(clocks(options).offsets(corrected));
    }

    private static DataStream<TopicRecord> cover(Inputs in, CoverageOptions options) {
        SingleOutputStreamOperator<WorkReport> reports = in.records()
                .process(new ReadWork(options.attributes(), ClockSkewLimit.of(options)))
                .uid("read-work")
                .name("Read positions and implements");

        SingleOutputStreamOperator<TopicRecord> fields = in.fields()
                .recordsBeside(in.records())
                .process(new ParseFields("coverage"))
                .setParallelism(1) // a version's records stay in order
                .uid("recognize-fields")
                .name("Recognize fields");

        SingleOutputStreamOperator<Swath> swaths = reports.keyBy(WorkReport::key)
                .connect(fields.broadcast())
                .transform(
                        "Build swaths",
                        TypeInformation.of(Swath.class),
                        new BroadcastLatenessOperator<>(
                                new BuildSwaths(options.rules(), in.fields().atStart()),
                                List.of(FieldVersions.BROADCAST)))
                .uid("build-swaths");

        SingleOutputStreamOperator<CoverageReport> coverages = swaths.keyBy(Swath::key)
                .process(new CoverField(options.rules()))
                .uid("cover-field")
                .name("Cover fields");

        return results(coverages, options)
                .union(
                        late(swaths, options),
                        clocks(options).watch(swaths.getSideOutput(BuildSwaths.LAGGING)),
                        clocks(options).delays(in.records()),
                        reports.getSideOutput(DeadLetters.TAG),
                        fields.getSideOutput(DeadLetters.TAG));
    }

    private static DataStream<TopicRecord> results(DataStream<CoverageReport> coverages, CoverageOptions options) {
        String output = options.output();
        String layerOutput = options.layerOutput();

        DataStream<TopicRecord> figures = coverages
                .map(report -> CoverageRecord.of(report, output))
                .uid("describe-coverages")
                .name("Describe coverages as entities");

        DataStream<TopicRecord> layers = coverages
                .filter(report -> report.layer() != null)
                .uid("select-layers")
                .name("Select layers")
                .map(report -> CoverageRecord.layer(report, layerOutput))
                .uid("describe-layers")
                .name("Describe layers as entities");

        return figures.union(layers);
    }

    private static DataStream<TopicRecord> late(SingleOutputStreamOperator<Swath> swaths, CoverageOptions options) {
        String lateOutput = options.lateOutput();
        return swaths.getSideOutput(BuildSwaths.LATE)
                .map(fix -> CoverageRecord.late(fix, lateOutput))
                .uid("describe-late-positions")
                .name("Describe late positions as entities");
    }

    private static ClockStage clocks(CoverageOptions options) {
        return new ClockStage("coverage", options);
    }
}
