package io.furrow.launcher;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.flink.JobCommandLine;
import io.furrow.launcher.control.AlarmCommand;
import io.furrow.launcher.control.DeviceCommand;
import io.furrow.launcher.control.DomainCommand;
import io.furrow.launcher.control.ReplayCommand;
import io.furrow.launcher.control.TemplateCommand;
import io.furrow.simulators.host.DeviceHostCommand;

/** The command {@code ./furrow}. */
@Command(
        name = "furrow",
        description = "Stream processing for FIWARE farms: from the context broker through Kafka and Flink and back.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = {
            DemoCommand.class,
            UpCommand.class,
            ControlPlaneCommand.class,
            DeviceHostCommand.class,
            ScenarioCommand.class,
            DomainCommand.class,
            MissionCommand.class,
            TemplateCommand.class,
            DeviceCommand.class,
            SecretCommand.class,
            AlarmCommand.class,
            ReplayCommand.class,
            ImagesCommand.class,
            CatalogCommand.class,
            FieldsCommand.class,
            DeadLettersCommand.class,
            BenchCommand.class
        })
public final class Furrow {
    @Mixin
    private HelpOption help;

    private Furrow() {}

    public static void main(String... args) {
        // Kafka and Connect write their logs through log4j, which must know its file before the first of them loads.
        System.setProperty("java.awt.headless", "true");
        int exitCode = commandLine().execute(args);
        System.exit(exitCode);
    }

    /** The command with all that it has. */
    public static CommandLine commandLine() {
        return JobCommandLine.of(new Furrow()).setExecutionExceptionHandler((failure, command, parsed) -> {
            if (failure instanceof SuiteNotStartedException refused) {
                command.getErr().println(refused.getMessage());
                return command.getCommandSpec().exitCodeOnExecutionException();
            }
            throw failure;
        });
    }
}
