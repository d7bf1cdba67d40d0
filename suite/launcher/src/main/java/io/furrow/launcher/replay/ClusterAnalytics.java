package io.furrow.launcher.replay;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.ArrayList;
import java.util.HexFormat;
import java.util.List;
import java.util.Map;
import java.util.Set;

import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.model.file.FileProblem;

/** Runs analytics of replays on a Flink cluster, through its REST API. The jar is uploaded once, under a name that includes its hash. */
final class ClusterAnalytics implements AnalyticsExecutor {
    private static final String MAIN = "io.furrow.analytics.AnalyticsJobs";
    private static final int HASH_BYTES = 6;

    private final FlinkRest flink;
    private final Path jar;
    private final List<String> options;
    private final boolean elastic;

    /**
     * @param options for every job, for instance {@code --bootstrap-servers}
     * @param elastic whether the cluster adds slots on demand
     */
    ClusterAnalytics(FlinkRest flink, Path jar, List<String> options, boolean elastic) {
        this.flink = flink;
        this.jar = jar;
        this.options = List.copyOf(options);
        this.elastic = elastic;
    }

    @Override
    public Set<String> running() throws AnalyticsException {
        return Set.copyOf(flink.jobs().keySet());
    }

    /** Unused slots: a job needs one, or as many as its parallelism. */
    @Override
    public int free() throws AnalyticsException {
        return elastic ? Integer.MAX_VALUE : flink.freeSlots();
    }

    @Override
    public void start(ReplayAnalyticsJob job) throws AnalyticsException {
        String name = jarName();
        String uploaded = flink.jar(name);
        List<String> arguments = new ArrayList<>(List.of(job.job()));
        arguments.addAll(job.options());
        arguments.addAll(options);
        flink.run(uploaded == null ? flink.upload(jar, name) : uploaded, MAIN, arguments);
    }

    @Override
    public void cancel(String name) throws AnalyticsException {
        Map<String, String> jobs = flink.jobs();
        if (jobs.containsKey(name)) {
            flink.cancel(jobs.get(name));
        }
    }

    private String jarName() throws AnalyticsException {
        try {
            byte[] digest = MessageDigest.getInstance("SHA-256").digest(Files.readAllBytes(jar));
            return "furrow-replay-analytics-" + HexFormat.of().formatHex(digest, 0, HASH_BYTES) + ".jar";
        } catch (IOException e) {
            throw new AnalyticsException(jar + " cannot be read: " + FileProblem.of(e) + "; check --jar", e);
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }
}
