package io.furrow.bench.frame;

import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Locale;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.HelpOption;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;

/** A benchmark as a command, configured by its options. Exit code 0 means that the results are complete and all comparisons agree. */
@Command(abbreviateSynopsis = true)
public abstract class Benchmark implements Callable<Integer> {
    /** The end of an option's description. */
    public static final String DEFAULT = "Default: ${DEFAULT-VALUE}.";

    @Spec
    private CommandSpec spec;

    @Mixin
    private HelpOption help;

    /** A measurement on a whole suite. */
    protected interface OnSuite {
        /** Returns the exit code. */
        int measure(Suite suite) throws Exception;
    }

    protected final CommandSpec spec() {
        return spec;
    }

    protected final PrintWriter out() {
        return spec.commandLine().getOut();
    }

    /** Prints progress. */
    protected final void say(String line) {
        out().println("  " + line);
        out().flush();
    }

    protected final void print(Figures figures) {
        figures.print(out());
    }

    protected final void print(String format, Object... values) {
        out().printf(Locale.ROOT, format, values);
        out().flush();
    }

    /** Measures on a suite in this JVM, on free ports. @param data null for a temporary directory */
    protected final int onSuite(Path data, OnSuite work) throws Exception {
        try (RunDirectory directory = RunDirectory.open(data);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out()))) {
            return work.measure(suite);
        }
    }
}
