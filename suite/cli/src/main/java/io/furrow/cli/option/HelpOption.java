package io.furrow.cli.option;

import picocli.CommandLine.Option;

/** What every command answers {@code --help} with. */
public final class HelpOption {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this help.")
    private boolean requested;
}
