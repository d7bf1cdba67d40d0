package io.furrow.flink.job;

import java.time.Duration;
import java.util.Locale;

import org.apache.flink.client.program.ProgramParametrizationException;
import picocli.CommandLine;
import picocli.CommandLine.ExecutionException;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.TypeConversionException;
import picocli.CommandLine.UnmatchedArgumentException;

/** The command line of a job jar: a root command with one subcommand per job. */
public final class JobCommandLine {
    /** As picocli says it. */
    private static final String NO_COMMAND = "Missing required subcommand";

    private static final int COLUMNS = 100;
    private static final int MIN_COLUMNS = 60;
    private static final int MAX_COLUMNS = 120;

    private JobCommandLine() {}

    /** Starts the job of the parsed options. */
    @FunctionalInterface
    public interface JobStarter {
        void start(JobOptions options) throws Exception;
    }

    /** The {@code main} of a job jar. */
    public static void run(Object root, JobStarter starter, String... args) {
        int exitCode = starting(root, starter).execute(args);
        if (exitCode != 0) {
            fail(exitCode);
        }
    }

    /** {@code main} also runs inside a job manager that serves others: the JVM is only ended without Flink. */
    private static void fail(int exitCode) {
        try {
            throw NotStarted.exception();
        } catch (NoClassDefFoundError e) {
            System.exit(exitCode);
        }
    }

    /** A separate class, because it cannot be loaded without Flink. */
    private static final class NotStarted {
        /** The reason has been printed; {@code flink run} prints only the message of this exception. */
        static RuntimeException exception() {
            return new ProgramParametrizationException("The job was not started.");
        }
    }

    /** A command line whose subcommands are options of jobs. */
    static CommandLine starting(Object root, JobStarter starter) {
        CommandLine line = of(root);
        return line.setExecutionStrategy(parsed -> {
            Integer help = CommandLine.executeHelpRequest(parsed);
            if (help != null) {
                return help;
            }
            CommandLine last =
                    parsed.asCommandLineList().get(parsed.asCommandLineList().size() - 1);
            if (!(last.getCommand() instanceof JobOptions options)) {
                throw new ParameterException(last, NO_COMMAND);
            }
            try {
                starter.start(options);
                return 0;
            } catch (ParameterException e) {
                throw e;
            } catch (Exception e) { // whatever Flink throws while it submits the job
                throw new ExecutionException(last, "the job could not be started", e);
            }
        });
    }

    /** A parser with converters for the value types of job options. */
    public static CommandLine of(Object command) {
        CommandLine line = new CommandLine(command);
        // Set on the root, inherited by every subcommand.
        return line.setCaseInsensitiveEnumValuesAllowed(true)
                .setUsageHelpWidth(columns(System.getenv("COLUMNS")))
                .setUsageHelpLongOptionsMaxWidth(36)
                .registerConverter(Duration.class, new DurationConverter())
                .registerConverter(Delivery.class, JobCommandLine::delivery)
                .registerConverter(StartPosition.class, StartPosition::of)
                .registerConverter(RecoveryOptions.Restart.class, JobCommandLine::restart)
                .setParameterExceptionHandler(JobCommandLine::explain)
                .setExecutionExceptionHandler((failure, refusing, parsed) -> {
                    if (failure instanceof ParameterException refused) {
                        return explain(refused, new String[0]);
                    }
                    throw failure;
                });
    }

    /** @param terminal its number of columns; null where the output is none */
    static int columns(String terminal) {
        return terminal == null || !terminal.matches("[1-9][0-9]{0,4}")
                ? COLUMNS
                : Math.max(MIN_COLUMNS, Math.min(Integer.parseInt(terminal), MAX_COLUMNS));
    }

    public static Delivery delivery(String text) {
        return switch (text.toLowerCase(Locale.ROOT)) {
            case "at-least-once" -> Delivery.AT_LEAST_ONCE;
            case "exactly-once" -> Delivery.EXACTLY_ONCE;
            default ->
                throw new TypeConversionException(
                        "'" + text + "' is not a delivery; write at-least-once or exactly-once");
        };
    }

    private static RecoveryOptions.Restart restart(String text) {
        return switch (text.toLowerCase(Locale.ROOT)) {
            case "exponential-delay" -> RecoveryOptions.Restart.EXPONENTIAL_DELAY;
            case "fixed-delay" -> RecoveryOptions.Restart.FIXED_DELAY;
            case "none" -> RecoveryOptions.Restart.NONE;
            default ->
                throw new TypeConversionException(
                        "'" + text + "' is not a way to restart; write exponential-delay, fixed-delay or none");
        };
    }

    /** Prints one sentence and a hint at the help, rather than the whole usage, except where a command is missing. */
    private static int explain(ParameterException refused, String[] args) {
        CommandLine line = refused.getCommandLine();
        if (refused.getMessage().equals(NO_COMMAND)) {
            line.usage(line.getErr());
        } else {
            line.getErr().println(refused.getMessage());
            UnmatchedArgumentException.printSuggestions(refused, line.getErr());
            line.getErr().println("See: " + line.getCommandSpec().qualifiedName() + " --help");
        }
        return line.getCommandSpec().exitCodeOnInvalidInput();
    }
}
