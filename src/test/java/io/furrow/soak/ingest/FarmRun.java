package io.furrow.soak.ingest;

import java.io.IOException;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.core.execution.RecoveryClaimMode;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.runtime.checkpoint.CheckpointStatsCounts;
import org.apache.flink.runtime.execution.ExecutionState;
import org.apache.flink.runtime.executiongraph.AccessExecutionGraph;
import org.apache.flink.runtime.executiongraph.AccessExecutionVertex;
import org.apache.flink.runtime.jobgraph.SavepointRestoreSettings;
import org.apache.flink.streaming.api.graph.StreamGraph;

import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;

import static org.awaitility.Awaitility.await;

/**
 * Runs the job {@code ingest}, exactly-once, with missions and images, on a broker and a cluster in this JVM, under
 * load.
 */
final class FarmRun implements AutoCloseable {
    private static final int SLOTS = 3;
    private static final Duration TIMEOUT = Duration.ofSeconds(60);

    private final Path folder;
    private final EmbeddedKafka kafka;
    private final EmbeddedMongo mongo;
    private final EmbeddedFlink flink;
    private final LoadWriter load;
    private CompletableFuture<Integer> writing;
    private JobID job;
    private int taskManagers;

    private FarmRun(Path folder) {
        this.folder = folder;
        this.kafka = EmbeddedKafka.start(folder.resolve("kafka"));
        this.mongo = EmbeddedMongo.start(folder.resolve("mongo"));
        this.flink = EmbeddedFlink.start(SLOTS, 0);
        this.load = new LoadWriter(kafka.bootstrapServers());
    }

    /** Starts servers and load, but not the job. */
    static FarmRun start(Path folder, int records, int perSecond) throws Exception {
        FarmRun run = new FarmRun(folder);
        run.load.createTopics();
        run.writing = CompletableFuture.supplyAsync(() -> run.load.write(perSecond, number -> number < records));
        return run;
    }

    /** @param savepoint null to start without state */
    void startJob(int parallelism, String savepoint) {
        IngestOptions options = new IngestOptions();
        String[] args = {
            "--delivery=exactly-once",
            "--bootstrap-servers=" + kafka.bootstrapServers(),
            "--mongo=" + mongo.uri(),
            "--images=" + images().toUri(),
            "--checkpoint-interval=300ms",
            "--restart-delay=50ms",
            "--topic-retention=36500d",
            "--parallelism=" + parallelism
        };
        JobCommandLine.of(options).parseArgs(args);
        StreamGraph graph = IngestJob.assemble(options).getStreamGraph();
        if (savepoint != null) {
            graph.setSavepointRestoreSettings(
                    SavepointRestoreSettings.forPath(savepoint, false, RecoveryClaimMode.NO_CLAIM));
        }
        job = flink.submit(graph);
        // A job that is being initialized cannot be queried.
        await().atMost(TIMEOUT).until(() -> flink.status(job) != JobStatus.INITIALIZING);
    }

    void awaitWritten(int records) {
        await().atMost(TIMEOUT).until(() -> load.written() >= records);
    }

    /** Returns once one more checkpoint is complete than at the call. */
    void awaitCheckpoint() throws Exception {
        long before = checkpoints().getNumberOfCompletedCheckpoints();
        await().atMost(TIMEOUT).until(() -> checkpoints().getNumberOfCompletedCheckpoints() > before);
    }

    /** How often the job was restored from a checkpoint. */
    long restored() throws Exception {
        return checkpoints().getNumberOfRestoredCheckpoints();
    }

    private CheckpointStatsCounts checkpoints() throws Exception {
        return graph().getCheckpointStatsSnapshot().getCounts();
    }

    private AccessExecutionGraph graph() throws Exception {
        return flink.cluster().getExecutionGraph(job).get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
    }

    private boolean isRunning() throws Exception {
        for (AccessExecutionVertex subtask : graph().getAllExecutionVertices()) {
            if (subtask.getExecutionState() != ExecutionState.RUNNING) {
                return false;
            }
        }
        return true;
    }

    /** Terminates the task manager with all its state, and starts another. */
    void replaceTaskManager() throws Exception {
        flink.cluster().terminateTaskManager(taskManagers++).get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
        flink.cluster().startTaskManager();
    }

    /** Stops the job with a savepoint. @return the savepoint's path */
    String stopJob() throws Exception {
        return stopJob(false);
    }

    /** @param drained whether event time first advances to its end, so that nothing waits for it */
    private String stopJob(boolean drained) throws Exception {
        await().atMost(TIMEOUT).until(this::isRunning);
        String target = folder.resolve("savepoints").toUri().toString();
        try {
            String savepoint = flink.cluster()
                    .stopWithSavepoint(job, target, drained, SavepointFormatType.CANONICAL)
                    .get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
            await().atMost(TIMEOUT).until(() -> flink.status(job).isGloballyTerminalState());
            return savepoint;
        } catch (ExecutionException e) {
            throw new IllegalStateException("no savepoint; what failed in the job: " + exceptions(), e);
        }
    }

    /** The job's failures from the REST API, newest first, as JSON. */
    private String exceptions() throws Exception {
        HttpRequest request = HttpRequest.newBuilder(
                        flink.webUi().resolve("/jobs/" + job + "/exceptions?maxExceptions=5"))
                .build();
        return HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofString())
                .body();
    }

    /** Waits for all output and the end of the job, and returns what was written. */
    IngestOutcome outcome() throws Exception {
        writing.get(TIMEOUT.toSeconds(), TimeUnit.SECONDS);
        load.awaitOutput(TIMEOUT);
        stopJob(true);
        return IngestOutcome.of(kafka.bootstrapServers(), mongo.uri(), images());
    }

    private Path images() {
        return folder.resolve("images");
    }

    @Override
    public void close() throws IOException {
        flink.close();
        mongo.close();
        kafka.close();
    }
}
