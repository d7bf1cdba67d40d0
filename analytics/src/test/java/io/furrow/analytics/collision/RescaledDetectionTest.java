package io.furrow.analytics.collision;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Queue;
import java.util.TreeSet;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.JobStatus;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.connector.source.SourceSplit;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiter;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiterStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.StateRecoveryOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.runtime.testutils.CommonTestUtils;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;
import org.apache.flink.test.junit5.InjectMiniCluster;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.EachEvent;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.DebounceRules;
import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.TestClusters;

import static org.assertj.core.api.Assertions.assertThat;

/** The stages killed in the middle of encounters and continued from a savepoint at another parallelism. */
class RescaledDetectionTest {
    private static final Logger LOG = LoggerFactory.getLogger(RescaledDetectionTest.class);

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(4);

    private static final long START = 1_700_000_000_000L;
    private static final int[] PARALLELISMS = {1, 2, 4, 2};
    /** How many positions come between a savepoint and the kill: what is made of them is made again. */
    private static final int AFTER_SAVEPOINT = 150;

    /** What every run wrote, and which positions may come; static because the tasks run in this process. */
    private static final Queue<Encounter> WRITTEN = new ConcurrentLinkedQueue<>();

    private static final Duration DWELL = Duration.ofMillis(300);
    private static final Gate GATE = new Gate();
    private static List<PositionFix> arrivals;

    @Tag("full")
    @Test
    void tellsTheSameAsAnUndisturbedRun(@InjectMiniCluster MiniCluster cluster, @TempDir Path savepoints)
            throws Exception {
        long seed = System.nanoTime();
        LOG.info("rescaled run from seed {}", seed);
        CollisionRules rules = Worlds.rules(5, 10, false).with(new DebounceRules(1.5, DWELL));
        List<PositionFix> fixes = worlds(rules.thresholdMeters(), seed);
        arrivals = new Worlds(seed).shuffled(fixes, DetectionRun.BOUND);
        List<Encounter> expected = CollisionOracle.encounters(fixes, rules);

        int eachTime = arrivals.size() / PARALLELISMS.length;
        String savepoint = null;
        for (int run = 0; run < PARALLELISMS.length - 1; run++) {
            int cut = (run + 1) * eachTime;
            assertThat(underWay(expected, cut)).as("encounters at the cut").isPositive();
            GATE.letPass(eachTime);
            JobClient job = start(rules, PARALLELISMS[run], savepoint);
            GATE.awaitAllPassed();
            CommonTestUtils.waitForAllTaskRunning(cluster, job.getJobID(), false);
            savepoint = job.triggerSavepoint(savepoints.toString(), SavepointFormatType.CANONICAL)
                    .get(60, TimeUnit.SECONDS);
            GATE.letPass(AFTER_SAVEPOINT);
            awaitWritten(expected, cut + AFTER_SAVEPOINT);
            kill(cluster, run, job);
        }
        GATE.letPass(arrivals.size());
        start(rules, PARALLELISMS[PARALLELISMS.length - 1], savepoint)
                .getJobExecutionResult()
                .get(60, TimeUnit.SECONDS);

        List<Encounter> written = distinct(WRITTEN);
        assertThat(CollisionOracle.difference(written, expected))
                .as("seed %d", seed)
                .isEmpty();
        assertThat(WRITTEN).as("what was made after a savepoint was made again").hasSizeGreaterThan(written.size());
    }

    private static List<PositionFix> worlds(double threshold, long seed) {
        List<PositionFix> fixes = new ArrayList<>();
        for (int i = 0; i < 18; i++) {
            String farm = "w" + i;
            new Worlds(seed + i)
                    .wander(Worlds.centre(i), threshold, START)
                    .forEach(fix -> fixes.add(Fixes.ofFarm(farm, fix)));
        }
        return fixes;
    }

    /** The task manager goes with all that its tasks hold, and another comes in its place. */
    private static void kill(MiniCluster cluster, int taskManager, JobClient job) throws Exception {
        cluster.terminateTaskManager(taskManager).get(60, TimeUnit.SECONDS);
        Awaitility.await().until(() -> job.getJobStatus().get().isGloballyTerminalState());
        assertThat(job.getJobStatus().get()).isEqualTo(JobStatus.FAILED);
        cluster.startTaskManager();
    }

    /** Else the kill may come before anything was made of the last positions. */
    private static void awaitWritten(List<Encounter> expected, int positions) {
        long watermark = watermark(positions);
        long due = expected.stream()
                .filter(encounter -> encounter.time() + DWELL.toMillis() <= watermark) // a start is told so much later
                .count();
        Awaitility.await().until(() -> distinct(WRITTEN).size() >= due);
    }

    /** After so many positions. */
    private static long watermark(int positions) {
        return arrivals.subList(0, positions).stream()
                        .mapToLong(HasEventTime::time)
                        .max()
                        .orElseThrow()
                - DetectionRun.BOUND
                - 1;
    }

    /** Encounters that have been told and have not ended when so many positions have come. */
    private static long underWay(List<Encounter> expected, int positions) {
        long watermark = watermark(positions);
        return expected.stream()
                .filter(encounter -> encounter.phase() == Phase.ENDED)
                .filter(encounter ->
                        encounter.startTime() + DWELL.toMillis() <= watermark && encounter.time() > watermark)
                .count();
    }

    private static List<Encounter> distinct(Iterable<Encounter> written) {
        TreeSet<Encounter> distinct = new TreeSet<>(CollisionOracle.ORDER
                .thenComparing(Encounter::phase)
                .thenComparing(Comparator.comparing(Record::toString)));
        written.forEach(distinct::add);
        return List.copyOf(distinct);
    }

    private static JobClient start(CollisionRules rules, int parallelism, String savepoint) throws Exception {
        Configuration settings = new Configuration().set(PipelineOptions.GENERIC_TYPES, false);
        if (savepoint != null) {
            settings.set(StateRecoveryOptions.SAVEPOINT_PATH, savepoint);
        }
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        env.setParallelism(parallelism).setMaxParallelism(16);
        DataStream<PositionFix> fixes = env.fromSource(
                        new DataGeneratorSource<>(
                                (GeneratorFunction<Long, PositionFix>) index -> arrivals.get(index.intValue()),
                                arrivals.size(),
                                new Gated<>(),
                                TypeInformation.of(PositionFix.class)),
                        WatermarkStrategy.<PositionFix>forGenerator(context -> new EachEvent<>(DetectionRun.BOUND))
                                .withTimestampAssigner((fix, previous) -> fix.time()),
                        "positions")
                .uid("positions")
                .setParallelism(1);
        CollisionDetection.define(fixes.keyBy(PositionFix::device), rules)
                .encounters()
                .map(RescaledDetectionTest::written)
                .uid("write")
                .sinkTo(new DiscardingSink<>())
                .uid("sink");
        return env.executeAsync();
    }

    private static Encounter written(Encounter encounter) {
        WRITTEN.add(encounter);
        return encounter;
    }

    /** Lets a number of positions pass and holds the next, without blocking the task. */
    private static final class Gate {
        private int left;
        private CompletableFuture<Void> held;

        synchronized void letPass(int more) {
            left = more;
            if (held != null) {
                CompletableFuture<Void> next = held;
                held = null;
                left--;
                next.complete(null);
            }
        }

        synchronized CompletionStage<Void> acquire() {
            if (left > 0) {
                left--;
                return CompletableFuture.completedFuture(null);
            }
            held = new CompletableFuture<>();
            return held;
        }

        synchronized void newRun() {
            held = null;
        }

        void awaitAllPassed() {
            Awaitility.await().until(this::isHolding);
        }

        private synchronized boolean isHolding() {
            return held != null;
        }
    }

    private static final class Gated<S extends SourceSplit> implements RateLimiterStrategy<S> {
        private static final long serialVersionUID = 1L;

        @Override
        public RateLimiter<S> createRateLimiter(int parallelism) {
            GATE.newRun();
            return requested -> GATE.acquire();
        }
    }
}
