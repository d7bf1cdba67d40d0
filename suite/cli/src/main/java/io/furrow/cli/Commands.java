package io.furrow.cli;

import java.util.List;

import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.command.CatalogCommand;
import io.furrow.cli.command.DeadLettersCommand;
import io.furrow.cli.command.FieldsCommand;
import io.furrow.cli.command.ImagesCommand;
import io.furrow.cli.command.MissionCommand;
import io.furrow.cli.control.AlarmCommand;
import io.furrow.cli.control.DeviceCommand;
import io.furrow.cli.control.DomainCommand;
import io.furrow.cli.control.ReplayCommand;
import io.furrow.cli.control.TemplateCommand;
import io.furrow.cli.option.CommandException;
import io.furrow.flink.job.JobCommandLine;

/** The commands that start nothing: they use the control plane, Kafka and stored missions wherever these run. */
public final class Commands {
    private static final List<Class<?>> ALL = List.of(
            DomainCommand.class,
            MissionCommand.class,
            TemplateCommand.class,
            DeviceCommand.class,
            AlarmCommand.class,
            ReplayCommand.class,
            ImagesCommand.class,
            CatalogCommand.class,
            FieldsCommand.class,
            DeadLettersCommand.class);

    private Commands() {}

    /** Adds the commands to those of a root; a {@link CommandException} is printed as one line. */
    public static CommandLine commandLine(Object root) {
        CommandSpec spec = CommandSpec.forAnnotatedObject(root);
        ALL.forEach(command -> spec.addSubcommand(null, new CommandLine(command)));
        CommandLine line = JobCommandLine.of(spec).setExecutionExceptionHandler((failure, command, parsed) -> {
            if (failure instanceof CommandException rejected) {
                command.getErr().println(rejected.getMessage());
                return command.getCommandSpec().exitCodeOnExecutionException();
            }
            throw failure;
        });
        // -3 is a number of events, not an option.
        line.getSubcommands().get("replay").getSubcommands().get("step").setUnmatchedOptionsArePositionalParams(true);
        return line;
    }
}
