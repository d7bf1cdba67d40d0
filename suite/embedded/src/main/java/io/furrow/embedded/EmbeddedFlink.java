package io.furrow.embedded;

import java.net.URI;
import java.util.concurrent.CompletionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.JobStatus;
import org.apache.flink.configuration.ClusterOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.MemorySize;
import org.apache.flink.configuration.RestOptions;
import org.apache.flink.configuration.SecurityOptions;
import org.apache.flink.configuration.TaskManagerOptions;
import org.apache.flink.configuration.WebOptions;
import org.apache.flink.runtime.minicluster.MiniCluster;
import org.apache.flink.runtime.minicluster.MiniClusterConfiguration;
import org.apache.flink.streaming.api.graph.ExecutionPlan;

import io.furrow.http.AllowedNames;
import io.furrow.http.flink.AccessOptions;

/**
 * A Flink cluster of one job manager and one task manager in this JVM, with the web UI on 127.0.0.1. The web UI and its REST API are
 * read-only; jobs are submitted and cancelled through this class.
 */
public final class EmbeddedFlink implements AutoCloseable {
    private static final String HOST = "127.0.0.1";
    private static final long START_SECONDS = 30;
    private static final long STOP_SECONDS = 8;

    private final MiniCluster cluster;
    private final URI webUi;

    private EmbeddedFlink(MiniCluster cluster, URI webUi) {
        this.cluster = cluster;
        this.webUi = webUi;
    }

    /**
     * Starts and waits until the web UI answers.
     *
     * @param slots number of task slots
     * @param webPort 0 for a free one
     */
    public static EmbeddedFlink start(int slots, int webPort) {
        return start(slots, webPort, AllowedNames.NONE);
    }

    /** @param allowed further hosts and origins of the web UI */
    public static EmbeddedFlink start(int slots, int webPort, AllowedNames allowed) {
        Configuration configuration = new Configuration();
        configuration.set(RestOptions.BIND_PORT, Integer.toString(webPort));
        configuration.set(RestOptions.BIND_ADDRESS, HOST);
        configuration.set(RestOptions.ADDRESS, HOST);
        configuration.set(AccessOptions.READ_ONLY, true);
        configuration.set(AccessOptions.ALLOWED_HOSTS, allowed.hosts());
        configuration.set(AccessOptions.ALLOWED_ORIGINS, allowed.origins());
        // One process needs no delegation tokens, and Flink would warn that there are none.
        configuration.set(SecurityOptions.DELEGATION_TOKENS_ENABLED, false);
        // Disables what the web UI offers by default.
        configuration.set(WebOptions.SUBMIT_ENABLE, false);
        configuration.set(WebOptions.CANCEL_ENABLE, false);
        configuration.set(WebOptions.RESCALE_ENABLE, false);
        configuration.set(TaskManagerOptions.MANAGED_MEMORY_SIZE, MemorySize.ofMebiBytes(32));
        configuration.set(TaskManagerOptions.NETWORK_MEMORY_MIN, MemorySize.ofMebiBytes(96));
        configuration.set(TaskManagerOptions.NETWORK_MEMORY_MAX, MemorySize.ofMebiBytes(96));
        configuration.set(RestOptions.SERVER_NUM_THREADS, 2);
        configuration.set(ClusterOptions.CLUSTER_IO_EXECUTOR_POOL_SIZE, 4);
        MiniCluster cluster = new MiniCluster(new MiniClusterConfiguration.Builder()
                .setConfiguration(configuration)
                .setNumTaskManagers(1)
                .setNumSlotsPerTaskManager(slots)
                .setCommonBindAddress(HOST)
                .build());
        try {
            cluster.start();
            return new EmbeddedFlink(cluster, cluster.getRestAddress().get(START_SECONDS, TimeUnit.SECONDS));
        } catch (Exception e) { // declared as such by Flink
            throw new IllegalStateException("Flink did not start", e);
        }
    }

    public URI webUi() {
        return webUi;
    }

    /** Submits a job and returns when the cluster has accepted it. */
    public JobID submit(ExecutionPlan plan) {
        return cluster.submitJob(plan).join().getJobID();
    }

    public JobStatus status(JobID job) {
        return cluster.getJobStatus(job).join();
    }

    /** The underlying cluster, to wait for a job's subtasks. */
    public MiniCluster cluster() {
        return cluster;
    }

    /** Cancels running jobs and stops; retained checkpoints stay. */
    @Override
    public void close() {
        try {
            cluster.closeAsync().get(STOP_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (TimeoutException | java.util.concurrent.ExecutionException | CompletionException e) {
            throw new IllegalStateException("Flink did not stop cleanly", e);
        }
    }
}
