package io.furrow.replay;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;

/** The command line of the replay jar: {@code flink run furrow-replay-….jar replay --help}. */
@Command(
        name = "furrow-replay",
        description = "Flink job that plays stored missions back.",
        subcommands = ReplayOptions.class)
public final class ReplayJobs {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this help.")
    private boolean help;

    private ReplayJobs() {}

    public static void main(String... args) {
        JobCommandLine.run(new ReplayJobs(), ReplayJobs::start, args);
    }

    private static void start(JobOptions options) throws Exception {
        if (options instanceof ReplayOptions replay) {
            ReplayJob.assemble(replay).execute();
        }
    }
}
