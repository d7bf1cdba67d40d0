package io.furrow.launcher.suite;

import java.nio.file.Path;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.cli.option.CommandException;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.launcher.process.Sleep;

/** The jobs of the suite on its Flink: each continues from its newest state below a directory, if there is one. */
final class Jobs {
    private static final Logger LOG = LoggerFactory.getLogger(Jobs.class);
    private static final long SAVEPOINT_SECONDS = 4;
    private static final Duration CHECKPOINT = Duration.ofSeconds(1);
    private static final Duration CHECK_INTERVAL = Duration.ofMillis(10);
    /** Within one process records need not be batched, and no thread per task is needed to flush buffers. */
    private static final long AT_ONCE = 0;

    private final EmbeddedFlink flink;
    private final Path directory;
    private final Map<String, JobID> running = new LinkedHashMap<>();

    /** @param directory has a folder per job, with its checkpoints and savepoints */
    Jobs(EmbeddedFlink flink, Path directory) {
        this.flink = flink;
        this.directory = directory;
    }

    synchronized void submit(String name, StreamExecutionEnvironment env) {
        env.setBufferTimeout(AT_ONCE);
        StreamGraph graph = env.getStreamGraph();
        graph.setJobName(name);
        LatestCheckpoint.below(directory.resolve(name))
                .ifPresent(state -> graph.setSavepointRestoreSettings(
                        SavepointRestoreSettings.forPath(JobFolder.location(state), false, RecoveryClaimMode.CLAIM)));
        running.put(name, flink.submit(graph));
    }

    /**
     * Waits until each job has restored its state.
     *
     * @throws CommandException if one cannot continue from it
     */
    synchronized void awaitStarted() {
        running.forEach((name, job) -> {
            while (flink.status(job) == JobStatus.INITIALIZING) {
                Sleep.of(CHECK_INTERVAL);
            }
            if (flink.status(job) == JobStatus.FAILED) {
                Path state = directory.resolve(name);
                throw new CommandException(
                        LatestCheckpoint.below(state).isEmpty()
                                ? "Job %s failed; see furrow.log.".formatted(name)
                                : ("Job %s cannot continue from its state in %s; see furrow.log. Move that folder away,"
                                                + " and the job begins anew: it reads again what Kafka still has.")
                                        .formatted(name, state));
            }
        });
    }

    /** Name and id of each job, in the order in which they were submitted. */
    synchronized Map<String, JobID> running() {
        return Map.copyOf(running);
    }

    /** Ends a job, if it runs, and deletes its state: another of the same name starts afresh. */
    synchronized void cancel(String name) {
        JobID job = running.remove(name);
        if (job != null && !flink.status(job).isGloballyTerminalState()) {
            flink.cluster().cancelJob(job).join();
            awaitEnd(job);
        }
        JobFolder.delete(directory.resolve(name));
    }

    /** Checkpoints may be in progress until the job has ended. */
    private void awaitEnd(JobID job) {
        long end = System.nanoTime() + TimeUnit.SECONDS.toNanos(SAVEPOINT_SECONDS);
        while (System.nanoTime() < end && !flink.status(job).isGloballyTerminalState()) {
            Sleep.of(CHECK_INTERVAL);
        }
    }

    /** Stops each job with a savepoint, so that nothing is processed twice after the next start. */
    synchronized void stop() {
        Map<String, CompletableFuture<String>> savepoints = new LinkedHashMap<>();
        long end = System.nanoTime() + CHECKPOINT.toNanos();
        running.forEach((name, job) -> {
            awaitCheckpoint(job, end);
            savepoints.put(name, stopWithSavepoint(name, job));
        });
        savepoints.forEach(Jobs::await);
    }

    private CompletableFuture<String> stopWithSavepoint(String name, JobID job) {
        String savepoints = JobFolder.location(directory.resolve(name));
        return flink.cluster().stopWithSavepoint(job, savepoints, false, SavepointFormatType.NATIVE);
    }

    /** Waits for a checkpoint in progress: a stop would abort it, which Flink reports as a failure. */
    private void awaitCheckpoint(JobID job, long end) {
        while (System.nanoTime() < end && isTakingCheckpoint(job)) {
            Sleep.of(CHECK_INTERVAL);
        }
    }

    private boolean isTakingCheckpoint(JobID job) {
        return flink.cluster()
                        .getExecutionGraph(job)
                        .thenApply(graph ->
                                graph.getCheckpointStatsSnapshot().getCounts().getNumberOfInProgressCheckpoints())
                        .completeOnTimeout(0, CHECKPOINT.toMillis(), TimeUnit.MILLISECONDS)
                        .exceptionally(failure -> 0) // of an ended job; its stop reports that
                        .join()
                > 0;
    }

    private static void await(String name, CompletableFuture<String> savepoint) {
        try {
            savepoint.get(SAVEPOINT_SECONDS, TimeUnit.SECONDS);
        } catch (ExecutionException | TimeoutException e) {
            LOG.warn(
                    "No savepoint of job {}: it will restart from its last checkpoint and process again what came after it",
                    name,
                    e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
