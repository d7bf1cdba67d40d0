package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

/**
 * A time, by the clock of the context broker, up to which all notified or missed changes of one subscription are
 * durable. Survives a restart in a file; never moves back.
 */
final class Watermark {
    private final TimeFile file;
    private Optional<Instant> time;

    private Watermark(TimeFile file, Optional<Instant> time) {
        this.file = file;
        this.time = time;
    }

    /** An unreadable file counts as missing: then more is read again than needed. */
    static Watermark open(Path path) throws IOException {
        TimeFile file = new TimeFile(path);
        try {
            return new Watermark(file, file.read());
        } catch (DateTimeException e) {
            return new Watermark(file, Optional.empty());
        }
    }

    Optional<Instant> time() {
        return time;
    }

    void advanceTo(Instant later) throws IOException {
        if (time.isPresent() && !later.isAfter(time.get())) {
            return;
        }
        file.write(later);
        time = Optional.of(later);
    }
}
