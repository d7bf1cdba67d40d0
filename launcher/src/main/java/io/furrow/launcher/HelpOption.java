package io.furrow.launcher;

import picocli.CommandLine.Option;

/** What every command answers {@code --help} with. */
final class HelpOption {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean asked;
}
