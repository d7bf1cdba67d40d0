package io.furrow.simulators.robot;

import java.util.Arrays;
import java.util.Optional;

/** What a robot can be told, as its attribute {@code cmd} spells it. */
public enum Command {
    RUNNING("Running"),
    STOP("Stop"),
    RESUME("Resume");

    private final String word;

    Command(String word) {
        this.word = word;
    }

    /** The command of this word; empty where there is none. */
    public static Optional<Command> of(String word) {
        return Arrays.stream(values())
                .filter(command -> command.word.equals(word))
                .findFirst();
    }

    @Override
    public String toString() {
        return word;
    }
}
