package io.furrow.launcher;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.ingest.image.PurgeImages;

/** {@code ./furrow images}. */
@Command(
        name = "images",
        description = "Looks after stored images.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = PurgeImages.class)
final class ImagesCommand {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean help;
}
