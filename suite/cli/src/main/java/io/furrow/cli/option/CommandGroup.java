package io.furrow.cli.option;

import picocli.CommandLine.Option;
import picocli.CommandLine.ScopeType;

/** A command that consists of subcommands only. */
public abstract class CommandGroup {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            scope = ScopeType.INHERIT,
            description = "Show this help.")
    private boolean help;
}
