package io.furrow.cli.command;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.cli.option.HelpOption;

/** {@code ./furrow images}. */
@Command(
        name = "images",
        description = "Manages stored images.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = PurgeImages.class)
public final class ImagesCommand {
    @Mixin
    private HelpOption help;
}
