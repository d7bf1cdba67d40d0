package io.furrow.connect.repair;

import java.io.IOException;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

/**
 * The oldest of the records that are stale and that {@link LastRecordCache} cannot track: what changed since has to be read again.
 * Survives a restart in a file. Thread-safe.
 */
final class LateRecords {
    /**
     * The records so far.
     *
     * @param from time of the oldest
     * @param count their number, to detect later ones
     */
    record Late(Instant from, long count) {}

    private final TimeFile file;
    private Optional<Late> late;

    private LateRecords(TimeFile file, Optional<Late> late) {
        this.file = file;
        this.late = late;
    }

    /** An unreadable file counts as the least time: then more is read again than needed. */
    static LateRecords open(Path path) throws IOException {
        TimeFile file = new TimeFile(path);
        try {
            return new LateRecords(file, file.read().map(from -> new Late(from, 1)));
        } catch (DateTimeException e) {
            return new LateRecords(file, Optional.of(new Late(Instant.EPOCH, 1)));
        }
    }

    synchronized Optional<Late> late() {
        return late;
    }

    synchronized void add(Instant time) throws IOException {
        Optional<Late> before = late;
        Instant from = before.map(Late::from).filter(time::isAfter).orElse(time);
        late = Optional.of(new Late(from, before.map(Late::count).orElse(0L) + 1));
        if (before.map(Late::from).filter(from::equals).isEmpty()) {
            file.write(from);
        }
    }

    /** Removes these after they were read again, unless others were added meanwhile. */
    synchronized void settle(Optional<Late> these) throws IOException {
        if (late.isPresent() && late.equals(these)) {
            file.delete();
            late = Optional.empty();
        }
    }
}
