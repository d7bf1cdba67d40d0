package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

/**
 * A time, by the clock of the context broker, up to which all notified or missed changes of one subscription are
 * durable. Survives a restart in a file; never moves back.
 */
public final class Watermark {
    private final Path file;
    private Optional<Instant> time;

    private Watermark(Path file, Optional<Instant> time) {
        this.file = file;
        this.time = time;
    }

    /** An unreadable file counts as missing: then more is read again than needed. */
    public static Watermark open(Path file) throws IOException {
        if (!Files.exists(file)) {
            return new Watermark(file, Optional.empty());
        }
        try {
            String text = new String(Files.readAllBytes(file), java.nio.charset.StandardCharsets.ISO_8859_1);
            return new Watermark(file, Optional.of(Instant.parse(text.trim())));
        } catch (DateTimeException e) {
            return new Watermark(file, Optional.empty());
        }
    }

    public Optional<Instant> time() {
        return time;
    }

    public void advanceTo(Instant later) throws IOException {
        if (time.isPresent() && !later.isAfter(time.get())) {
            return;
        }
        Path next = file.resolveSibling(file.getFileName() + ".tmp");
        Files.writeString(next, later + "\n");
        try (FileChannel channel = FileChannel.open(next, StandardOpenOption.WRITE)) {
            channel.force(true);
        }
        Files.move(next, file, StandardCopyOption.REPLACE_EXISTING, StandardCopyOption.ATOMIC_MOVE);
        time = Optional.of(later);
    }
}
