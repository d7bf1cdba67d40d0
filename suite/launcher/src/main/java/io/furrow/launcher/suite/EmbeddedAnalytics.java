package io.furrow.launcher.suite;

import java.util.Map;
import java.util.Set;
import java.util.concurrent.CompletionException;
import java.util.stream.Collectors;

import org.apache.flink.api.common.JobID;
import org.apache.flink.util.FlinkRuntimeException;

import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.cli.option.CommandException;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.launcher.replay.AnalyticsException;
import io.furrow.launcher.replay.AnalyticsExecutor;
import io.furrow.model.result.AnalyticsKind;

/** Runs analytics of replays on the suite's Flink, in reserved slots. */
final class EmbeddedAnalytics implements AnalyticsExecutor {
    /** Four replays with all jobs each. */
    static final int SLOTS = 4 * AnalyticsKind.values().length;

    private final EmbeddedFlink flink;
    private final Jobs jobs;
    private final SuiteJobs plans;
    private final Set<String> others;

    /** @param jobs includes those that belong to no replay */
    EmbeddedAnalytics(EmbeddedFlink flink, Jobs jobs, SuiteJobs plans) {
        this.flink = flink;
        this.jobs = jobs;
        this.plans = plans;
        this.others = jobs.running().keySet();
    }

    @Override
    public Set<String> running() throws AnalyticsException {
        try {
            return jobs.running().entrySet().stream()
                    .filter(job -> !others.contains(job.getKey()))
                    .filter(job -> isAlive(job.getValue()))
                    .map(Map.Entry::getKey)
                    .collect(Collectors.toUnmodifiableSet());
        } catch (CompletionException e) {
            throw new AnalyticsException("The embedded Flink does not tell its jobs", e);
        }
    }

    private boolean isAlive(JobID job) {
        return !flink.status(job).isGloballyTerminalState();
    }

    @Override
    public int free() throws AnalyticsException {
        return SLOTS - running().size();
    }

    @Override
    public void start(ReplayAnalyticsJob job) throws AnalyticsException {
        try {
            jobs.submit(job.name(), plans.ofReplay(job));
        } catch (CommandException | FlinkRuntimeException | CompletionException e) {
            throw new AnalyticsException("The embedded Flink does not take " + job.name(), e);
        }
    }

    @Override
    public void cancel(String name) throws AnalyticsException {
        try {
            jobs.cancel(name);
        } catch (CompletionException e) {
            throw new AnalyticsException("The embedded Flink does not end " + name, e);
        }
    }
}
