package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.journal.DurableFiles;

/** A time in a file, replaced as a whole: after a power cut the file holds the old time or the new one. */
record TimeFile(Path path) {
    /**
     * Returns empty if there is no file.
     *
     * @throws DateTimeException if it holds something else than a time
     */
    Optional<Instant> read() throws IOException {
        if (!Files.exists(path)) {
            return Optional.empty();
        }
        return Optional.of(Instant.parse(new String(Files.readAllBytes(path), StandardCharsets.ISO_8859_1).trim()));
    }

    void write(Instant time) throws IOException {
        Path next = path.resolveSibling(path.getFileName() + ".tmp");
        Files.writeString(next, time + "\n");
        DurableFiles.replace(path, next);
    }

    void delete() throws IOException {
        Files.deleteIfExists(path);
    }
}
