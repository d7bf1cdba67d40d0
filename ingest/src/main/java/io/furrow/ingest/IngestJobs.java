package io.furrow.ingest;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.ingest.normalize.NormalizeJob;
import io.furrow.ingest.normalize.NormalizeOptions;

/** The command line of the ingest jar: {@code flink run furrow-ingest-….jar ingest --help}. */
@Command(
        name = "furrow-ingest",
        description = "Flink jobs that route events and store missions, images and the latest state.",
        subcommands = {IngestOptions.class, NormalizeOptions.class})
public final class IngestJobs {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this help.")
    private boolean help;

    private IngestJobs() {}

    public static void main(String... args) {
        JobCommandLine.run(new IngestJobs(), IngestJobs::start, args);
    }

    private static void start(JobOptions options) throws Exception {
        if (options instanceof IngestOptions ingest) {
            IngestJob.assemble(ingest).execute();
        } else if (options instanceof NormalizeOptions normalize) {
            NormalizeJob.assemble(normalize).execute();
        }
    }
}
