package io.furrow.cli;

import java.lang.reflect.Method;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Stream;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.command.CatalogCommand;
import io.furrow.cli.command.ContextCommandGroup;
import io.furrow.cli.command.FieldsCommandGroup;
import io.furrow.cli.command.ImagesCommand;
import io.furrow.cli.command.MissionCommandGroup;
import io.furrow.cli.control.AlarmCommandGroup;
import io.furrow.cli.control.ApplyCommand;
import io.furrow.cli.control.AuditCommand;
import io.furrow.cli.control.DeadLetterCommandGroup;
import io.furrow.cli.control.DeviceCommandGroup;
import io.furrow.cli.control.DomainCommandGroup;
import io.furrow.cli.control.ReplayCommandGroup;
import io.furrow.cli.control.StatusCommand;
import io.furrow.cli.control.TemplateCommandGroup;
import io.furrow.cli.control.TopicCommandGroup;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.Contexts;
import io.furrow.cli.time.TimeConverter;
import io.furrow.flink.job.JobCommandLine;

/** Commands that start nothing: they use the control plane, Kafka and stored missions wherever these run. */
public final class Commands {
    public static final List<Class<?>> ALL = List.of(
            StatusCommand.class,
            DomainCommandGroup.class,
            MissionCommandGroup.class,
            ApplyCommand.class,
            TemplateCommandGroup.class,
            DeviceCommandGroup.class,
            AlarmCommandGroup.class,
            ReplayCommandGroup.class,
            ImagesCommand.class,
            CatalogCommand.class,
            FieldsCommandGroup.class,
            TopicCommandGroup.class,
            DeadLetterCommandGroup.class,
            AuditCommand.class,
            ContextCommandGroup.class);

    private Commands() {}

    /**
     * Adds commands to a root; a {@link CommandException} is printed as one line.
     *
     * @param args of the first command, if it is known: only the model of the method that they name is built
     */
    public static CommandLine commandLine(Object root, List<Class<?>> commands, String... args) {
        CommandSpec spec = CommandSpec.forAnnotatedObject(root);
        commands.forEach(command -> spec.addSubcommand(null, command(command, args)));
        CommandLine line = JobCommandLine.of(spec).registerConverter(Instant.class, new TimeConverter());
        return line.setExecutionExceptionHandler((failure, command, parsed) -> {
            if (failure instanceof CommandException rejected) {
                command.getErr().println(rejected.getMessage());
                return command.getCommandSpec().exitCodeOnExecutionException();
            }
            throw failure;
        });
    }

    private static CommandLine command(Class<?> type, String... args) {
        CommandLine command = new CommandLine(type);
        if (!type.getAnnotation(Command.class).addMethodSubcommands()) {
            List<Method> methods = methods(type);
            List<Method> named = methods.stream()
                    .filter(method -> args.length > 0 && name(method).equals(args[0]))
                    .toList();
            (named.isEmpty() ? methods : named).forEach(method -> command.addSubcommand(new CommandLine(method)));
        }
        if (type == ReplayCommandGroup.class && command.getSubcommands().containsKey("step")) {
            // -3 is a number of events, not an option.
            command.getSubcommands().get("step").setUnmatchedOptionsArePositionalParams(true);
        }
        if (type == MissionCommandGroup.class && command.getSubcommands().containsKey("marker")) {
            // -5m is a time.
            command.getSubcommands().get("marker").setUnmatchedOptionsArePositionalParams(true);
        }
        // Servers start with what they are given only, and a context that cannot be read is no reason to show no help.
        boolean help = Stream.of(args).anyMatch(List.of("-h", "--help")::contains);
        return ALL.contains(type) && type != ContextCommandGroup.class && !help
                ? command.setDefaultValueProvider(new Contexts())
                : command;
    }

    /** Returns the commands of a type, those of its superclass first, each sorted by name. */
    private static List<Method> methods(Class<?> type) {
        List<Method> methods = new ArrayList<>();
        if (type != Object.class) {
            methods.addAll(methods(type.getSuperclass()));
            Arrays.stream(type.getDeclaredMethods())
                    .filter(method -> method.isAnnotationPresent(Command.class))
                    .sorted(Comparator.comparing(Commands::name))
                    .forEach(methods::add);
        }
        return methods;
    }

    private static String name(Method method) {
        return method.getAnnotation(Command.class).name();
    }
}
