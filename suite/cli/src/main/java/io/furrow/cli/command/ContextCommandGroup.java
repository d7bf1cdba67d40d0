package io.furrow.cli.command;

import java.io.IOException;
import java.util.List;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.CommandGroup;
import io.furrow.cli.option.Contexts;

/** {@code ./furrow context}. */
@Command(
        name = "context",
        description = {
            "Lists and selects contexts: files ~/.config/furrow/NAME.properties with defaults of the options api, api-ca, "
                    + "token-file, mongo and output.",
            "$FURROW_CONTEXT selects one for a shell. An option that is given, and a variable such as $FURROW_API, precede "
                    + "the context."
        },
        synopsisSubcommandLabel = "COMMAND")
public final class ContextCommandGroup extends CommandGroup {
    private final Contexts contexts;

    @Spec
    private CommandSpec spec;

    public ContextCommandGroup() {
        this(new Contexts());
    }

    ContextCommandGroup(Contexts contexts) {
        this.contexts = contexts;
    }

    @Command(name = "list", description = "Lists the contexts; * marks the one in use.")
    int list() {
        return run(() -> {
            String current = contexts.current();
            List<String> names = contexts.names();
            names.forEach(name -> print("%s %s".formatted(name.equals(current) ? "*" : " ", name)));
            if (names.isEmpty()) {
                print("There are no contexts; a file ~/.config/furrow/NAME.properties is one.");
            }
        });
    }

    @Command(name = "use", description = "Uses a context from now on; without NAME none.")
    int use(@Parameters(paramLabel = "NAME", arity = "0..1", description = "As list shows it.") String name) {
        return run(() -> {
            contexts.use(name);
            show();
        });
    }

    @Command(name = "show", description = "Shows the context in use and its values.")
    int showCurrent() {
        return run(this::show);
    }

    private void show() throws IOException {
        String current = contexts.current();
        if (current == null) {
            print("No context is in use.");
        } else {
            Map<String, String> values = contexts.read(current);
            print("context %s".formatted(current));
            values.forEach((option, value) -> print("%s=%s".formatted(option, value)));
        }
    }

    /** A use of the files. */
    private interface Work {
        void run() throws IOException;
    }

    private static int run(Work work) {
        try {
            work.run();
            return 0;
        } catch (IOException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    private void print(String line) {
        spec.commandLine().getOut().println(line);
        spec.commandLine().getOut().flush();
    }
}
