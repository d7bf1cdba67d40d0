package io.furrow.cli.option;

import java.io.Console;
import java.util.List;
import java.util.function.UnaryOperator;

import picocli.CommandLine.Option;

/** The option {@code --yes}: without it, a command asks at a terminal before it deletes or stops things. Elsewhere it never asks. */
public final class Confirmation {
    private static final int NAMED = 5;

    /** Prints a question and reads the answer; null if nobody is there. */
    private final UnaryOperator<String> terminal;

    @Option(
            names = {"-y", "--yes"},
            description = "Do not ask. Only at a terminal a question is asked.")
    private boolean yes;

    /** COLUMNS is set where the output is a terminal, which alone from Java 22 on a console does not say. */
    public Confirmation() {
        this(System.getenv("COLUMNS") == null ? null : console());
    }

    Confirmation(UnaryOperator<String> terminal) {
        this.terminal = terminal;
    }

    private static UnaryOperator<String> console() {
        Console console = System.console();
        return console == null ? null : question -> console.readLine("%s", question);
    }

    /** Whether a question is asked; otherwise nothing need be read for it. */
    public boolean isAsked() {
        return terminal != null && !yes;
    }

    /** Asks whether to do it. @throws CommandException unless the answer is yes */
    public void ask(String question) {
        if (isAsked()) {
            String answer = terminal.apply(question + " [y/N] ");
            if (answer == null || !answer.strip().matches("(?i)y|yes")) {
                throw new CommandException("Nothing was done.");
            }
        }
    }

    /** Returns for instance {@code mission m}, {@code 2 missions (a, b)}. */
    public static String named(String thing, List<String> names) {
        return names.size() == 1
                ? thing + " " + names.get(0)
                : "%d %ss (%s%s)"
                        .formatted(
                                names.size(),
                                thing,
                                String.join(", ", names.subList(0, Math.min(NAMED, names.size()))),
                                names.size() > NAMED ? ", …" : "");
    }
}
