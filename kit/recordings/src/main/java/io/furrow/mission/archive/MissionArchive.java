package io.furrow.mission.archive;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.time.LocalDate;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.Locale;

import org.apache.flink.core.fs.Path;

import io.furrow.mission.EventOrder;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.file.ArchiveLine;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Archives missions on any of Flink's file systems as {@code <root>/mission_<mission>/<day>-<nnnn>.ndjson.gz}, by the
 * day of the event time in UTC. Archiving again adds new events in further files and never changes or removes a file,
 * so that documents may expire in MongoDB.
 */
public record MissionArchive(StoredMissions missions, Path root) {
    private static final int DIGITS = 4;

    /** Returns the folder of a mission's files. */
    public Path folder(String mission) {
        return new Path(root, missions.collection(mission));
    }

    /**
     * The result of archiving a mission.
     *
     * @param files number of new files
     * @param added number of new events
     * @param kept number of events that were already archived
     */
    public record Outcome(int files, long added, long kept) {}

    /** Adds the events of a mission in MongoDB to the archive. */
    public Outcome archive(String mission) throws IOException {
        try (StoredMissions.Events events = missions.events(mission)) {
            return archive(folder(mission), events);
        }
    }

    /** Adds the events of a mission's export to its folder. @param lines a file as {@link StoredMissions#export} writes it */
    public static Outcome archive(Path folder, Path lines) throws IOException {
        try (BufferedReader reader = reader(lines)) {
            return archive(folder, events(lines, reader));
        }
    }

    private static Outcome archive(Path folder, Iterator<StoredEvent> events) throws IOException {
        Outcome all = new Outcome(0, 0, 0);
        try {
            PeekableEvents stored = new PeekableEvents(events);
            while (stored.event != null) {
                Outcome day = archive(folder, day(stored.event), stored);
                all = new Outcome(all.files() + day.files(), all.added() + day.added(), all.kept() + day.kept());
            }
        } catch (UncheckedIOException e) {
            throw e.getCause();
        }
        return all;
    }

    private static Outcome archive(Path folder, LocalDate day, PeekableEvents stored) throws IOException {
        List<Path> parts = MissionFiles.list(folder)
                .filter(it -> it.getName().startsWith(day + "-"))
                .toList();
        List<BufferedReader> open = new ArrayList<>();
        try {
            List<Iterator<StoredEvent>> lines = new ArrayList<>();
            for (Path part : parts) {
                BufferedReader reader = reader(part);
                open.add(reader);
                lines.add(events(part, reader));
            }
            NewEvents newEvents = new NewEvents(day, stored, new PeekableEvents(EventOrder.merged(lines)));
            if (!newEvents.skipArchived()) {
                return new Outcome(0, 0, newEvents.existing);
            }
            Path next = new Path(
                    folder, String.format(Locale.ROOT, "%s-%0" + DIGITS + "d.ndjson.gz", day, nextNumber(parts)));
            long added = MissionFiles.write(next, newEvents::writeTo);
            return new Outcome(1, added, newEvents.existing);
        } finally {
            for (BufferedReader reader : open) {
                reader.close();
            }
        }
    }

    /** Returns the number of the next file. */
    private static int nextNumber(List<Path> parts) {
        if (parts.isEmpty()) {
            return 1;
        }
        String last = parts.get(parts.size() - 1).getName();
        int dash = last.lastIndexOf('-');
        return 1 + Integer.parseInt(last.substring(dash + 1, last.indexOf('.', dash)));
    }

    private static BufferedReader reader(Path file) throws IOException {
        return new BufferedReader(new InputStreamReader(MissionFiles.open(file), StandardCharsets.UTF_8));
    }

    private static Iterator<StoredEvent> events(Path file, BufferedReader lines) {
        return lines.lines().map(line -> read(file, line)).iterator();
    }

    private static StoredEvent read(Path file, String line) {
        try {
            return ArchiveLine.read(line);
        } catch (UnreadableException e) {
            throw new UncheckedIOException(
                    new IOException(file + " holds a line that is not an event: " + e.getMessage(), e));
        }
    }

    private static LocalDate day(StoredEvent event) {
        return LocalDate.ofInstant(Instant.ofEpochMilli(event.time()), ZoneOffset.UTC);
    }

    /** An iterator with access to its next element. */
    private static final class PeekableEvents {
        private final Iterator<StoredEvent> rest;
        /** Null at the end. */
        private StoredEvent event;

        PeekableEvents(Iterator<StoredEvent> rest) {
            this.rest = rest;
            advance();
        }

        void advance() {
            event = rest.hasNext() ? rest.next() : null;
        }
    }

    /** Finds the stored events of a day that are not archived; both sequences are ordered. */
    private static final class NewEvents {
        private final LocalDate day;
        private final PeekableEvents stored;
        private final PeekableEvents archived;
        private long existing;

        NewEvents(LocalDate day, PeekableEvents stored, PeekableEvents archived) {
            this.day = day;
            this.stored = stored;
            this.archived = archived;
        }

        /** Continues to the next event that is not archived; false if there is none on this day. */
        boolean skipArchived() {
            while (stored.event != null && day(stored.event).equals(day)) {
                while (archived.event != null && EventOrder.COMPARATOR.compare(archived.event, stored.event) < 0) {
                    archived.advance();
                }
                if (archived.event == null || EventOrder.COMPARATOR.compare(archived.event, stored.event) != 0) {
                    return true;
                }
                existing++;
                stored.advance();
            }
            return false;
        }

        long writeTo(java.io.OutputStream out) throws IOException {
            long added = 0;
            while (skipArchived()) {
                out.write(ArchiveLine.write(stored.event));
                out.write('\n');
                added++;
                stored.advance();
            }
            return added;
        }
    }
}
