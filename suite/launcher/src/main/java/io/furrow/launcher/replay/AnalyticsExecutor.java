package io.furrow.launcher.replay;

import java.util.Set;

import io.furrow.cli.control.ReplayAnalyticsJob;

/** Runs analytics jobs of replays. Jobs are identified by name; other jobs are not touched. */
public interface AnalyticsExecutor {
    /** Names of all jobs that run or are starting. */
    Set<String> running() throws AnalyticsException;

    /** The number of further jobs for which there are slots. */
    int free() throws AnalyticsException;

    /** Returns when the job is accepted. */
    void start(ReplayAnalyticsJob job) throws AnalyticsException;

    /** Ends the job of that name, if it runs. */
    void cancel(String name) throws AnalyticsException;
}
