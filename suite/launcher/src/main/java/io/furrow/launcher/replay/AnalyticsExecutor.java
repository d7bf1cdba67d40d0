package io.furrow.launcher.replay;

import java.util.Set;

import io.furrow.cli.control.ReplayAnalyticsJob;

/** Where analytics jobs of replays run. Jobs are known by their names; what it runs beside them is not touched. */
public interface AnalyticsExecutor {
    /** Names of all jobs that run or are about to. */
    Set<String> running() throws AnalyticsException;

    /** How many more jobs fit. */
    int free() throws AnalyticsException;

    /** Returns when the job is accepted. */
    void start(ReplayAnalyticsJob job) throws AnalyticsException;

    /** Ends the job of that name, if it runs. */
    void cancel(String name) throws AnalyticsException;
}
