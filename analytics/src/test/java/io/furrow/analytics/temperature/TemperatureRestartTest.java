package io.furrow.analytics.temperature;

import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.execution.ExecutionState;
import org.apache.flink.runtime.executiongraph.AccessExecutionVertex;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.apache.flink.test.junit5.InjectMiniCluster;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.analytics.field.FieldInput;
import io.furrow.flink.TopicRecord;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Timeout(240)
class TemperatureRestartTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.cluster(4);

    private static final Duration PATIENCE = Duration.ofSeconds(60);

    private final Collected collected = new Collected();
    private int alreadyRead;

    @TempDir
    private Path savepoints;

    @Test
    void givesTheResultsOfAnUndisturbedRunWhenRestartedAndRescaledWithinWindows(@InjectMiniCluster MiniCluster flink)
            throws Exception {
        List<TopicRecord> readings = readings();
        List<String> undisturbed = results(JobRun.over(readings, arguments(1)).records());

        String first = stop(flink, run(flink, null, readings, 0, 170, 1), 170);
        String second = stop(flink, run(flink, first, readings, 170, 333, 2), 333);
        String third = stop(flink, run(flink, second, readings, 333, 471, 4), 471);
        JobID last = run(flink, third, readings, 471, readings.size(), 2);
        flink.requestJobResult(last).get(PATIENCE.toSeconds(), TimeUnit.SECONDS);

        assertThat(undisturbed).hasSizeGreaterThan(20).anyMatch(result -> result.contains("Analytics:SuspectDevice"));
        assertThat(results(collected.records())).isEqualTo(undisturbed);
    }

    /** Out of order by less than the bound; one device is defective, and one falls silent. */
    private static List<TopicRecord> readings() {
        Random random = new Random(42);
        List<TopicRecord> readings = new ArrayList<>();
        for (int i = 0; i < 600; i++) {
            long time = 1_700_000_000_000L + i * 500L - random.nextInt(2_000);
            int device = i % 6;
            if (device != 5 || i < 200) {
                readings.add(Farm.north("t" + device, device == 3 ? 60 : 18 + random.nextInt(10) / 10.0, time));
            }
        }
        return readings;
    }

    private static TemperatureOptions arguments(int parallelism) {
        return Farm.options(
                Farm.FIELDS,
                "--parallelism=" + parallelism,
                "--window=20s",
                "--slide=10s",
                "--out-of-orderness=3s",
                "--suspect-after=4",
                "--empty-windows");
    }

    private static List<String> results(List<TopicRecord> records) {
        return records.stream()
                .map(record -> record.topic() + " " + new String(record.value(), StandardCharsets.UTF_8))
                .sorted()
                .toList();
    }

    private JobID run(
            MiniCluster flink, String savepoint, List<TopicRecord> readings, int from, int until, int subtasks)
            throws Exception {
        TemperatureOptions options = arguments(subtasks);
        StreamExecutionEnvironment env = JobRun.environment(options);
        DataStream<TopicRecord> paused = env.fromSource(
                        PausedReadings.of(readings, from, until), WatermarkStrategy.noWatermarks(), "Readings")
                .setParallelism(1)
                .uid("readings")
                .assignTimestampsAndWatermarks(JobRun.watermarks(options))
                .setParallelism(1)
                .uid("watermarks");
        TemperatureJob.define(new TemperatureJob.Inputs(paused, FieldInput.of(env, options, options.fields())), options)
                .sinkTo(collected)
                .uid("collect");
        StreamGraph graph = env.getStreamGraph();
        if (savepoint != null) {
            graph.setSavepointRestoreSettings(
                    SavepointRestoreSettings.forPath(savepoint, false, RecoveryClaimMode.NO_CLAIM));
        }
        return flink.submitJob(graph).get().getJobID();
    }

    /** Stops the job once it has read up to the pause; where its savepoint is. */
    private String stop(MiniCluster flink, JobID job, int read) throws Exception {
        await().atMost(PATIENCE).until(() -> InTurn.counted(job, "accepted") >= read - alreadyRead);
        await().atMost(PATIENCE).until(() -> isRunning(flink, job));
        alreadyRead = read;
        return flink.stopWithSavepoint(job, savepoints.toUri().toString(), false, SavepointFormatType.CANONICAL)
                .get(PATIENCE.toSeconds(), TimeUnit.SECONDS);
    }

    /** All of it: there is no savepoint while a subtask still starts. The stream of fields may have ended. */
    private static boolean isRunning(MiniCluster flink, JobID job) throws Exception {
        for (AccessExecutionVertex subtask : flink.getExecutionGraph(job).get().getAllExecutionVertices()) {
            ExecutionState state = subtask.getExecutionState();
            if (state != ExecutionState.RUNNING && state != ExecutionState.FINISHED) {
                return false;
            }
        }
        return true;
    }
}
