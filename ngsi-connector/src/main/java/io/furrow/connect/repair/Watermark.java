package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.journal.DurableFiles;

/**
 * A time, by the clock of the context broker, up to which all notified or missed changes of one subscription are
 * durable. Survives a restart in a file, a line {@code TIME SUBSCRIPTION}; never moves back.
 */
final class Watermark {
    private final Path path;
    private Optional<Instant> time = Optional.empty();
    private String subscription = "";

    private Watermark(Path path) {
        this.path = path;
    }

    /** An unreadable file counts as missing: then more is read again than needed. */
    static Watermark open(Path path) throws IOException {
        Watermark watermark = new Watermark(path);
        if (Files.exists(path)) {
            String[] words = Files.readString(path, StandardCharsets.ISO_8859_1).split("\\s+");
            try {
                watermark.time = Optional.of(Instant.parse(words[0]));
                watermark.subscription = words.length > 1 ? words[1] : "";
            } catch (DateTimeException e) {
                return watermark;
            }
        }
        return watermark;
    }

    Optional<Instant> time() {
        return time;
    }

    /**
     * Whether it is that of another subscription. The context broker then has another database than before, or an
     * earlier state of it: a change before the watermark may be missing.
     */
    boolean isOfOther(String current) {
        return !subscription.isEmpty() && !subscription.equals(current);
    }

    void advanceTo(Instant later, String current) throws IOException {
        if (!isOfOther(current) && !time.map(later::isAfter).orElse(true)) {
            return;
        }
        Path next = path.resolveSibling(path.getFileName() + ".tmp");
        Files.writeString(next, later + " " + current + "\n");
        DurableFiles.replace(path, next);
        time = Optional.of(later);
        subscription = current;
    }
}
