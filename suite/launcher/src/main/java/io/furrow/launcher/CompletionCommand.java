package io.furrow.launcher;

import java.io.IOException;
import java.io.InputStream;
import java.io.PrintWriter;
import java.io.UncheckedIOException;

import picocli.AutoComplete;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.HelpOption;

import static java.nio.charset.StandardCharsets.UTF_8;

/** {@code ./furrow generate-completion}: picocli's script, and one that asks the control plane for names. */
@Command(
        name = "generate-completion",
        helpCommand = true,
        description = {
            "Generates completions for bash and zsh: of commands, options, their values, and the names of missions, devices, "
                    + "replays and the like.",
            "To use it here: source <(./furrow generate-completion)"
        })
final class CompletionCommand implements Runnable {
    private static final String NAMES = "names.bash";

    @Spec
    private CommandSpec spec;

    @Mixin
    private HelpOption help;

    @Override
    public void run() {
        PrintWriter out = spec.commandLine().getOut();
        out.print(AutoComplete.bash(spec.root().name(), spec.root().commandLine()));
        try (InputStream names = CompletionCommand.class.getResourceAsStream(NAMES)) {
            out.print(new String(names.readAllBytes(), UTF_8));
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        out.flush();
    }
}
