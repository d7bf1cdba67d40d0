package io.furrow.analytics.coverage;

import java.util.List;
import java.util.Random;
import java.util.Set;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.junit.jupiter.api.Tag;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.restart.JobCase;
import io.furrow.flink.restart.RestartContract;
import io.furrow.flink.restart.Restarts;

@Tag("full")
class CoverageRestartTest extends RestartContract {
    CoverageRestartTest() {
        super("coverage", Case::new);
    }

    /** Robots that drive through a field, with late positions. */
    private static final class Case extends JobCase {
        private final Drives drives;

        Case(long seed) {
            drives = new Drives(seed);
            Random random = Restarts.random(seed);
            long newest = 0;
            for (WorkReport report : drives.arrivals()) {
                newest = Math.max(newest, report.time());
                arrivals.add(new Arrival(CoverageRun.report(report), false));
                if (newest > Drives.START + 40_000 && random.nextInt(10) == 0) {
                    TopicRecord late = CoverageRun.report(report).at(newest - 12_000 - random.nextInt(10_000));
                    arrivals.add(new Arrival(late, true));
                }
            }
        }

        @Override
        public long bound() {
            return Drives.BOUND;
        }

        @Override
        public JobOptions options(int parallelism) {
            return CoverageRun.options("--parallelism=" + parallelism, "--cell=1");
        }

        @Override
        public DataStream<TopicRecord> define(
                StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) {
            return CoverageJob.define(
                    new CoverageJob.Inputs(records, CoverageRun.fields(env, drives.fields.all())),
                    (CoverageOptions) options);
        }

        @Override
        public Set<String> topics() {
            return Set.of("data.coverage", "data.coverage.layer", "data.coverage.late");
        }

        @Override
        public List<String> judges() {
            return List.of("Build swaths");
        }
    }
}
