package io.furrow.flink;

import java.time.Duration;

import picocli.CommandLine;
import picocli.CommandLine.ParameterException;

/** The command line of a job jar: a root command with one subcommand per job. */
public final class JobCommandLine {
    private JobCommandLine() {}

    /** What {@code main} of a job jar does. */
    public static void run(Object root, String... args) {
        int exitCode = of(root).execute(args);
        if (exitCode != 0) {
            // No System.exit: main also runs inside a job manager that serves others.
            throw new JobNotStarted();
        }
    }

    /** A parser with the value types that job options have. */
    public static CommandLine of(Object command) {
        return new CommandLine(command)
                .setCaseInsensitiveEnumValuesAllowed(true)
                .registerConverter(Duration.class, new DurationConverter())
                .registerConverter(
                        Delivery.class,
                        text -> Delivery.valueOf(
                                text.toUpperCase(java.util.Locale.ROOT).replace('-', '_')))
                .setExecutionExceptionHandler((failure, command1, parsed) -> {
                    if (failure instanceof ParameterException refused) {
                        return command1.getParameterExceptionHandler().handleParseException(refused, args(parsed));
                    }
                    throw failure;
                });
    }

    private static String[] args(CommandLine.ParseResult parsed) {
        return parsed.originalArgs().toArray(String[]::new);
    }

    /** The reason has been printed; a stack trace would only hide it. */
    private static final class JobNotStarted extends RuntimeException {
        private static final long serialVersionUID = 1L;

        JobNotStarted() {
            super("the job was not started", null, false, false);
        }
    }
}
