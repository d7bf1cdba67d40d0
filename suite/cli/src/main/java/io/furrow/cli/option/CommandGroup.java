package io.furrow.cli.option;

import picocli.CommandLine.Option;
import picocli.CommandLine.ScopeType;

/** A command that does nothing itself; each of its subcommands explains itself. */
public abstract class CommandGroup {
    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            scope = ScopeType.INHERIT,
            description = "Show this help.")
    private boolean help;
}
