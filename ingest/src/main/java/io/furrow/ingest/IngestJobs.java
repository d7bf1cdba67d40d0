package io.furrow.ingest;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.flink.JobCommandLine;
import io.furrow.ingest.normalise.NormaliseOptions;

/** The command line of the ingest jar: {@code flink run furrow-ingest-….jar ingest --help}. */
@Command(
        name = "furrow-ingest",
        description = "Flink jobs that bring events to everything that is made of them.",
        subcommands = {IngestOptions.class, NormaliseOptions.class})
public final class IngestJobs {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean help;

    private IngestJobs() {}

    public static void main(String... args) {
        JobCommandLine.run(new IngestJobs(), args);
    }
}
