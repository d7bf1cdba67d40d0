package io.furrow.cli;

import java.util.List;

import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.command.CatalogCommand;
import io.furrow.cli.command.DeadLettersCommand;
import io.furrow.cli.command.FieldsCommandGroup;
import io.furrow.cli.command.ImagesCommand;
import io.furrow.cli.command.MissionCommandGroup;
import io.furrow.cli.control.AlarmCommandGroup;
import io.furrow.cli.control.DeviceCommandGroup;
import io.furrow.cli.control.DomainCommandGroup;
import io.furrow.cli.control.ReplayCommandGroup;
import io.furrow.cli.control.TemplateCommandGroup;
import io.furrow.cli.option.CommandException;
import io.furrow.flink.job.JobCommandLine;

/** Commands that start nothing: they use the control plane, Kafka and stored missions wherever these run. */
public final class Commands {
    public static final List<Class<?>> ALL = List.of(
            DomainCommandGroup.class,
            MissionCommandGroup.class,
            TemplateCommandGroup.class,
            DeviceCommandGroup.class,
            AlarmCommandGroup.class,
            ReplayCommandGroup.class,
            ImagesCommand.class,
            CatalogCommand.class,
            FieldsCommandGroup.class,
            DeadLettersCommand.class);

    private Commands() {}

    /** Adds commands to a root; a {@link CommandException} is printed as one line. */
    public static CommandLine commandLine(Object root, List<Class<?>> commands) {
        CommandSpec spec = CommandSpec.forAnnotatedObject(root);
        commands.forEach(command -> spec.addSubcommand(null, new CommandLine(command)));
        CommandLine line = JobCommandLine.of(spec).setExecutionExceptionHandler((failure, command, parsed) -> {
            if (failure instanceof CommandException rejected) {
                command.getErr().println(rejected.getMessage());
                return command.getCommandSpec().exitCodeOnExecutionException();
            }
            throw failure;
        });
        if (commands.contains(ReplayCommandGroup.class)) {
            // -3 is a number of events, not an option.
            line.getSubcommands()
                    .get("replay")
                    .getSubcommands()
                    .get("step")
                    .setUnmatchedOptionsArePositionalParams(true);
        }
        return line;
    }
}
