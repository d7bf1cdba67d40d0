package io.furrow.launcher;

import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.HelpCommand;
import picocli.CommandLine.IExecutionStrategy;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.cli.Commands;
import io.furrow.cli.option.HelpOption;
import io.furrow.launcher.command.ControlPlaneCommand;
import io.furrow.launcher.command.DashboardCommand;
import io.furrow.launcher.command.DemoCommand;
import io.furrow.launcher.command.InitCommand;
import io.furrow.launcher.command.ScenarioCommand;
import io.furrow.launcher.command.SecretCommandGroup;
import io.furrow.launcher.command.UpCommand;
import io.furrow.launcher.process.ClockWatch;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.replay.AnalyticsCommand;
import io.furrow.simulators.host.DeviceHostCommand;

/** The command {@code ./furrow}. */
@Command(
        name = "furrow",
        description = "Stream processing for FIWARE farms: from the context broker through Kafka and Flink and back.",
        synopsisSubcommandLabel = "COMMAND",
        footer = {"", "./furrow bench measures the suite on this machine, ./furrow soak runs long checks."})
public final class Furrow {
    private static final List<Class<?>> COMMANDS = Stream.concat(
                    Stream.of(
                            DemoCommand.class,
                            UpCommand.class,
                            ControlPlaneCommand.class,
                            DashboardCommand.class,
                            DeviceHostCommand.class,
                            ScenarioCommand.class,
                            SecretCommandGroup.class,
                            InitCommand.class),
                    Commands.ALL.stream())
            .toList();

    @Mixin
    private HelpOption help;

    @Option(
            names = {"-V", "--version"},
            versionHelp = true,
            description = "Show the version.")
    private boolean version;

    private Furrow() {}

    public static void main(String... args) {
        // Kafka and Connect log through log4j, which must know its file before the first of them loads.
        System.setProperty("java.awt.headless", "true");
        int exitCode = commandLine(args)
                .setOut(AsciiWriter.to(System.out))
                .setErr(AsciiWriter.to(System.err))
                .execute(args);
        System.exit(exitCode);
    }

    /** The command with all subcommands. */
    public static CommandLine commandLine() {
        return commandLine(new String[0]);
    }

    /** The command with the subcommand that the first argument names, else with all: their models take most of a short run. */
    static CommandLine commandLine(String... args) {
        String name = args.length > 0 ? args[0] : "";
        List<Class<?>> named = COMMANDS.stream()
                .filter(command -> command.getAnnotation(Command.class).name().equals(name))
                .limit(1)
                .toList();
        CommandLine furrow = named.isEmpty()
                ? Commands.commandLine(new Furrow(), COMMANDS)
                : Commands.commandLine(new Furrow(), named, Arrays.copyOfRange(args, 1, args.length));
        CommandLine replay = furrow.getSubcommands().get("replay");
        if (replay != null && (args.length < 2 || !replay.getSubcommands().containsKey(args[1]))) {
            replay.addSubcommand(new AnalyticsCommand());
        }
        furrow.addSubcommand(new HelpCommand());
        furrow.addSubcommand(new CompletionCommand());
        HelpExamples.addTo(furrow);
        furrow.getCommandSpec().version(Version.TEXT);
        IExecutionStrategy strategy = furrow.getExecutionStrategy();
        return furrow.setExecutionStrategy(parsed -> {
            if (parsed.hasSubcommand() && parsed.subcommand().commandSpec().userObject() instanceof DeviceHostCommand) {
                LogFile.writeToErrorStream(); // its module does not depend on log4j
                ClockWatch.endProcess(); // nor on this one
            }
            return strategy.execute(parsed);
        });
    }
}
