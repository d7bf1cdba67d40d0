package io.furrow.launcher;

import java.nio.file.Path;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.flink.api.common.JobID;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.embedded.EmbeddedFlink;

/** The jobs of the suite on its Flink: each goes on from its newest state below a directory, if there is any. */
final class Jobs {
    private static final Logger LOG = LoggerFactory.getLogger(Jobs.class);
    private static final long SAVEPOINT_SECONDS = 4;

    private final EmbeddedFlink flink;
    private final Path directory;
    private final Map<String, JobID> running = new LinkedHashMap<>();

    /** @param directory holds a folder per job, with its checkpoints and savepoints */
    Jobs(EmbeddedFlink flink, Path directory) {
        this.flink = flink;
        this.directory = directory;
    }

    void submit(String name, StreamExecutionEnvironment env) {
        StreamGraph graph = env.getStreamGraph();
        graph.setJobName(name);
        NewestState.below(directory.resolve(name))
                .ifPresent(state -> graph.setSavepointRestoreSettings(
                        SavepointRestoreSettings.forPath(state.toUri().toString(), false, RecoveryClaimMode.CLAIM)));
        running.put(name, flink.submit(graph));
    }

    /** Name and id of each job, in the order in which they were submitted. */
    Map<String, JobID> running() {
        return Map.copyOf(running);
    }

    /** Stops each job with a savepoint, so that nothing is done twice after the next start. */
    void stop() {
        Map<String, CompletableFuture<String>> savepoints = new LinkedHashMap<>();
        running.forEach((name, job) -> savepoints.put(
                name,
                flink.cluster()
                        .stopWithSavepoint(
                                job, directory.resolve(name).toUri().toString(), false, SavepointFormatType.NATIVE)));
        savepoints.forEach(Jobs::await);
    }

    private static void await(String name, CompletableFuture<String> savepoint) {
        try {
            savepoint.get(SAVEPOINT_SECONDS, TimeUnit.SECONDS);
        } catch (ExecutionException | TimeoutException e) {
            LOG.warn(
                    "No savepoint of job {}: it will go on from its last checkpoint and repeat what came after it",
                    name,
                    e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
