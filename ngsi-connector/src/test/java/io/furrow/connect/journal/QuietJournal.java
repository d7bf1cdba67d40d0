package io.furrow.connect.journal;

import java.io.IOException;
import java.io.RandomAccessFile;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.core.config.Configurator;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.files.Folders;

/** A folder for a journal that will be damaged: each damage would be a line in the log. */
abstract class QuietJournal {
    Path folder;

    @BeforeAll
    static void keepQuiet() {
        Configurator.setLevel("io.furrow.connect.journal", Level.OFF);
    }

    @AfterAll
    static void speakAgain() {
        Configurator.setLevel("io.furrow.connect.journal", Level.ERROR);
    }

    @BeforeEach
    void makeFolder(@TempDir Path parent) throws Exception {
        folder = Files.createDirectory(parent.resolve("0-journal"));
    }

    /** Its segments, oldest first. */
    List<Path> segments() throws IOException {
        return Folders.list(folder).stream()
                .filter(file -> file.toString().endsWith(".segment"))
                .toList();
    }

    static void overwrite(Path file, long at, byte value) throws IOException {
        try (RandomAccessFile bytes = new RandomAccessFile(file.toFile(), "rw")) {
            bytes.seek(at);
            bytes.write(value);
        }
    }
}
