package io.furrow.connect.journal;

import java.nio.file.Path;

/** A program: prints whether it can open the journal in the folder that is its argument. */
public final class JournalOpener {
    private JournalOpener() {}

    /** Runs it. */
    public static void main(String[] arguments) {
        JournalSettings settings = JournalSettings.of(64 * 1024 * 1024, 1024 * 1024, 0);
        System.out.println(
                "opened " + Journal.open(Path.of(arguments[0]), settings).isPresent());
    }
}
