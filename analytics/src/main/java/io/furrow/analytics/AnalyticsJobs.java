package io.furrow.analytics;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.coverage.CoverageOptions;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;

/** The analytics job jar: one subcommand per job. Touches no Flink type until a job is started. */
@Command(
        name = "furrow-analytics",
        synopsisSubcommandLabel = "JOB",
        description = "Answers one question about what devices report, per job.",
        subcommands = {CollisionOptions.class, CoverageOptions.class, PresenceOptions.class, TemperatureOptions.class})
public final class AnalyticsJobs {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this help.")
    private boolean help;

    public static void main(String[] args) {
        JobCommandLine.run(new AnalyticsJobs(), AnalyticsJobs::start, args);
    }

    private static void start(JobOptions options) throws Exception {
        AnalyticsRegistry.assemble((AnalyticsOptions) options).execute();
    }
}
