package io.furrow.flink.restart;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.SplittableRandom;
import java.util.TreeMap;
import java.util.concurrent.Callable;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.TimeUnit;
import java.util.function.LongFunction;
import java.util.function.Predicate;
import java.util.stream.Stream;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.checkpoint.CheckpointException;
import org.apache.flink.runtime.execution.ExecutionState;
import org.apache.flink.runtime.executiongraph.AccessExecutionJobVertex;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.flink.util.FileUtils;
import org.awaitility.Awaitility;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.files.Folders;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.apache.flink.runtime.execution.ExecutionState.FINISHED;
import static org.apache.flink.runtime.execution.ExecutionState.RUNNING;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * Runs a job over the same input once undisturbed and once stopped with a savepoint or killed after a checkpoint, aligned or
 * unaligned, at random records, the first and none among them, and continued at another parallelism: what is written is equal.
 * {@code -Dfurrow.restarts.cases} says how many inputs, {@code -Dfurrow.restarts.seed} with which they begin.
 */
public record Restarts(MiniCluster flink, Path folder) {
    private static final Logger LOG = LoggerFactory.getLogger(Restarts.class);
    /** At most so many records are on their way when a checkpoint begins. */
    public static final int ON_THEIR_WAY = 20;

    /** Below the folder of the module. */
    private static final String STORED = "src/test/resources/stored-savepoints";

    /** The names of sources begin with it. */
    private static final String SOURCE = "Source: ";

    /** Of the newest cluster: closed with its cluster, a reporter sees nothing of another. */
    private static volatile InMemoryReporter metrics;

    /** With the metrics that the runs look at. */
    public static MiniClusterExtension cluster() {
        return new MiniClusterExtension(() -> {
            metrics =
                    InMemoryReporter.create(); // closed with its cluster; of a test that is run again there are several
            return new MiniClusterResourceConfiguration.Builder()
                    .setNumberTaskManagers(1)
                    .setNumberSlotsPerTaskManager(4)
                    .setConfiguration(metrics.addToConfiguration(new Configuration()))
                    .build();
        });
    }

    /** @param caseOf the case of a seed */
    public void changeNothing(int cases, LongFunction<JobCase> caseOf) throws Exception {
        long first = Long.getLong("furrow.restarts.seed", System.nanoTime());
        int all = Integer.getInteger("furrow.restarts.cases", cases);
        for (long seed = first; seed < first + all; seed++) {
            JobCase job = caseOf.apply(seed);
            LOG.info("{} with restarts, seed {}", job.options(1).jobName(), seed);
            Map<String, String> undisturbed = undisturbed(job);
            assertThat(Written.records()).extracting(TopicRecord::topic).containsAll(job.topics());
            String how = disturbed(job, random(seed));
            Map<String, String> disturbed = merged(job);
            assertThat(without(undisturbed, disturbed))
                    .as("missing, seed %d: %s", seed, how)
                    .isEmpty();
            assertThat(without(disturbed, undisturbed))
                    .as("too many, seed %d: %s", seed, how)
                    .isEmpty();
        }
        LOG.info("restarts: {} cases without a difference, from seed {}", all, first);
    }

    /** Neighboring seeds give random numbers that begin differently. */
    public static Random random(long seed) {
        return new Random(new SplittableRandom(seed).nextLong());
    }

    /**
     * Continues from the savepoints of releases, each taken in the middle of this case, whose input must therefore never change:
     * with what was written until then, all is as in an undisturbed run.
     *
     * @param name folder of the job in {@value #STORED}, which has one folder per release; {@code -Dfurrow.savepoints.release=R}
     *     puts one of what the job is now there
     */
    public void goOnFromReleases(String name, JobCase job) throws Exception {
        Map<String, String> undisturbed = undisturbed(job);
        Written.clear();
        int cut = job.arrivals.size() / 2;
        JobID first = start(job, 0, new Run(2, false), null);
        pass(first, Math.max(0, cut - ON_THEIR_WAY));
        Input.awaitJudges();
        pass(first, cut);
        Path now = Path.of(URI.create(stop(first)));
        List<TopicRecord> before = Written.records();
        Path releases = Path.of(STORED, name);
        String release = System.getProperty("furrow.savepoints.release");
        if (release != null) {
            FileUtils.copy(
                    new org.apache.flink.core.fs.Path(now.toUri()),
                    new org.apache.flink.core.fs.Path(releases.resolve(release).toUri()),
                    false);
        }
        List<Path> stored = Folders.list(releases);
        assertThat(stored).isNotEmpty();
        for (Path savepoint : stored) {
            Written.beginWith(before);
            JobID run = start(job, cut, new Run(2, false), savepoint.toUri().toString());
            Input.GATE.open(Integer.MAX_VALUE);
            end(run);
            assertThat(merged(job)).as("from %s", savepoint).isEqualTo(undisturbed);
        }
    }

    private Map<String, String> undisturbed(JobCase job) throws Exception {
        Written.clear();
        JobID run = start(job, 0, new Run(2, false), null);
        Input.GATE.open(Integer.MAX_VALUE);
        end(run);
        return merged(job);
    }

    private String disturbed(JobCase job, Random random) throws Exception {
        Written.clear();
        StringBuilder how = new StringBuilder();
        int last = job.arrivals.size() - 1;
        int position = 0;
        String state = null;
        int restarts = 2 + random.nextInt(3);
        for (int restart = 0; restart < restarts; restart++) {
            int cut = random.nextInt(4) == 0 ? position : position + random.nextInt((last - position) / 2 + 1);
            Run now = Run.any(random);
            JobID run = start(job, position, now, state);
            pass(run, Math.max(position, cut - ON_THEIR_WAY));
            Input.awaitJudges();
            pass(run, cut);
            boolean stopped = random.nextInt(3) == 0;
            state = stopped ? stop(run) : kill(run, Math.min(last, cut + random.nextInt(60)));
            how.append(now)
                    .append(stopped ? " stopped at " : " killed after ")
                    .append(cut)
                    .append(", ");
            position = cut;
        }
        Run now = Run.any(random);
        JobID run = start(job, position, now, state);
        Input.GATE.open(Integer.MAX_VALUE);
        end(run);
        return how.append(now).toString();
    }

    /** How a run is set. */
    private record Run(int parallelism, boolean unaligned) {
        private static Run any(Random random) {
            return new Run(1 << random.nextInt(3), random.nextBoolean());
        }
    }

    private JobID start(JobCase job, int position, Run how, String state) throws Exception {
        JobOptions options = job.options(how.parallelism);
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.configure(new Configuration()
                .set(RestartStrategyOptions.RESTART_STRATEGY, "none")
                .set(CheckpointingOptions.CHECKPOINTING_INTERVAL, Duration.ofHours(1))
                .set(CheckpointingOptions.CHECKPOINTS_DIRECTORY, folder.toUri().toString())
                .set(CheckpointingOptions.ENABLE_UNALIGNED, how.unaligned));
        job.define(env, Input.of(env, job), options).sinkTo(new Written()).uid("write");
        StreamGraph graph = env.getStreamGraph();
        if (state != null) {
            graph.setSavepointRestoreSettings(
                    SavepointRestoreSettings.forPath(state, false, RecoveryClaimMode.NO_CLAIM));
        }
        Input.newRun(job, position, new Judges(metrics, graph.getJobID(), job.judges(), how.parallelism, job.bound()));
        JobID run = flink.submitJob(graph).get().getJobID();
        await(run, () -> isRunning(run));
        return run;
    }

    private void pass(JobID run, int until) {
        Input.GATE.open(until);
        await(run, () -> Input.GATE.isAt(until));
    }

    /** There is no checkpoint while a subtask still starts. A source that a job has beside its events may have ended. */
    private boolean isRunning(JobID run) throws Exception {
        return subtasks(run, vertex -> true).allMatch(state -> state == RUNNING || state == FINISHED)
                && subtasks(run, vertex -> true).findAny().isPresent(); // none while the job is being set up
    }

    private boolean hasOnlyItsInput(JobID run) throws Exception {
        return subtasks(run, vertex -> vertex.startsWith(SOURCE) && !vertex.startsWith(SOURCE + Input.NAME))
                .allMatch(state -> state == FINISHED);
    }

    private Stream<ExecutionState> subtasks(JobID run, Predicate<String> vertices) throws Exception {
        List<ExecutionState> states = new ArrayList<>();
        for (AccessExecutionJobVertex vertex :
                flink.getExecutionGraph(run).get().getVerticesTopologically()) {
            if (vertices.test(vertex.getName())) {
                Stream.of(vertex.getTaskVertices()).forEach(subtask -> states.add(subtask.getExecutionState()));
            }
        }
        return states.stream();
    }

    private void await(JobID run, Callable<Boolean> condition) {
        Awaitility.await()
                .pollDelay(Duration.ZERO)
                .pollInterval(Duration.ofMillis(2))
                .failFast("the job has ended", () -> requireUnended(run))
                .until(condition);
    }

    /** Says why it has ended, if it failed. */
    private void requireUnended(JobID run) throws Exception {
        if (flink.getJobStatus(run).get().isTerminalState()) {
            end(run);
            throw new IllegalStateException("it ended by itself");
        }
    }

    /**
     * One that fails has ended the input, and cannot be tried again. So checkpoints show before that all subtasks are ready for one, and
     * let the sources end that have nothing more.
     */
    private String stop(JobID run) throws Exception {
        await(run, () -> {
            taken(() -> flink.triggerCheckpoint(run));
            return hasOnlyItsInput(run);
        });
        return flink.stopWithSavepoint(run, folder.toUri().toString(), false, SavepointFormatType.CANONICAL)
                .get(1, TimeUnit.MINUTES);
    }

    /** A subtask that runs may still be unready for a checkpoint. */
    private static String taken(Callable<CompletableFuture<String>> checkpoint) {
        return Awaitility.await()
                .pollDelay(Duration.ZERO)
                .ignoreExceptionsMatching(e -> e.getCause() instanceof CheckpointException)
                .until(() -> checkpoint.call().get(1, TimeUnit.MINUTES), path -> true);
    }

    /** A checkpoint, and then some records more whose results are made again. */
    private String kill(JobID run, int until) throws Exception {
        String checkpoint = taken(() -> flink.triggerCheckpoint(run));
        pass(run, until);
        flink.cancelJob(run).get(1, TimeUnit.MINUTES);
        Awaitility.await()
                .pollInterval(Duration.ofMillis(2))
                .until(() -> flink.getJobStatus(run).get() == JobStatus.CANCELED);
        return checkpoint;
    }

    private void end(JobID run) throws Exception {
        flink.requestJobResult(run)
                .get(2, TimeUnit.MINUTES)
                .toJobExecutionResult(getClass().getClassLoader());
    }

    /** Identity → content. */
    private static Map<String, String> merged(JobCase job) {
        Map<String, String> merged = new TreeMap<>();
        for (TopicRecord record : Written.records()) {
            merged.put(job.identity(record), job.content(record));
        }
        return merged;
    }

    private static Map<String, String> without(Map<String, String> all, Map<String, String> others) {
        Map<String, String> rest = new TreeMap<>(all);
        rest.entrySet().removeAll(others.entrySet());
        return rest;
    }

    /** Topic, key, time and value of a record; its headers say when it was written. */
    public static String text(TopicRecord record) {
        return String.join(
                " ", record.topic(), of(record.key()), Long.toString(record.timestamp()), of(record.value()));
    }

    private static String of(byte[] bytes) {
        return bytes == null ? "-" : new String(bytes, UTF_8);
    }
}
