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
 * A mission's second place on any of Flink's file systems: {@code <root>/mission_<mission>/<day>-<nnnn>.ndjson.gz}, by the day
 * of the event time in UTC. Archiving again adds what has come since, in further files; nothing that is there is ever changed
 * or removed, so that documents may expire in MongoDB.
 */
public record MissionArchive(StoredMissions missions, Path root) {
    private static final int DIGITS = 4;

    /** Where the files of a mission are. */
    public Path folder(String mission) {
        return new Path(root, missions.collection(mission));
    }

    /**
     * What was done.
     *
     * @param files that are new
     * @param added events that were not in the archive
     * @param kept events that were
     */
    public record Outcome(int files, long added, long kept) {}

    /** Brings what MongoDB holds of a mission into the archive. */
    public Outcome archive(String mission) throws IOException {
        Outcome all = new Outcome(0, 0, 0);
        try (StoredMissions.Events events = missions.events(mission)) {
            Ahead stored = new Ahead(events);
            while (stored.event != null) {
                Outcome day = archive(folder(mission), day(stored.event), stored);
                all = new Outcome(all.files() + day.files(), all.added() + day.added(), all.kept() + day.kept());
            }
        } catch (UncheckedIOException e) {
            throw e.getCause();
        }
        return all;
    }

    private static Outcome archive(Path folder, LocalDate day, Ahead stored) throws IOException {
        List<Path> parts = MissionFiles.list(folder)
                .filter(it -> it.getName().startsWith(day + "-"))
                .toList();
        List<BufferedReader> open = new ArrayList<>();
        try {
            List<Iterator<StoredEvent>> lines = new ArrayList<>();
            for (Path part : parts) {
                BufferedReader reader =
                        new BufferedReader(new InputStreamReader(MissionFiles.open(part), StandardCharsets.UTF_8));
                open.add(reader);
                lines.add(reader.lines().map(line -> read(part, line)).iterator());
            }
            News news = new News(day, stored, new Ahead(EventOrder.merged(lines)));
            if (!news.skipKnown()) {
                return new Outcome(0, 0, news.known);
            }
            Path next =
                    new Path(folder, String.format(Locale.ROOT, "%s-%0" + DIGITS + "d.ndjson.gz", day, after(parts)));
            long added = MissionFiles.write(next, news::writeTo);
            return new Outcome(1, added, news.known);
        } finally {
            for (BufferedReader reader : open) {
                reader.close();
            }
        }
    }

    /** The number after the last. */
    private static int after(List<Path> parts) {
        if (parts.isEmpty()) {
            return 1;
        }
        String last = parts.get(parts.size() - 1).getName();
        int dash = last.lastIndexOf('-');
        return 1 + Integer.parseInt(last.substring(dash + 1, last.indexOf('.', dash)));
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

    /** An iterator whose next element can be looked at. */
    private static final class Ahead {
        private final Iterator<StoredEvent> rest;
        /** Null at the end. */
        private StoredEvent event;

        Ahead(Iterator<StoredEvent> rest) {
            this.rest = rest;
            advance();
        }

        void advance() {
            event = rest.hasNext() ? rest.next() : null;
        }
    }

    /** What of a day is stored and not in the archive; both are in order. */
    private static final class News {
        private final LocalDate day;
        private final Ahead stored;
        private final Ahead archived;
        private long known;

        News(LocalDate day, Ahead stored, Ahead archived) {
            this.day = day;
            this.stored = stored;
            this.archived = archived;
        }

        /** Continues to the next that is new; false if there is none on this day. */
        boolean skipKnown() {
            while (stored.event != null && day(stored.event).equals(day)) {
                while (archived.event != null && EventOrder.COMPARATOR.compare(archived.event, stored.event) < 0) {
                    archived.advance();
                }
                if (archived.event == null || EventOrder.COMPARATOR.compare(archived.event, stored.event) != 0) {
                    return true;
                }
                known++;
                stored.advance();
            }
            return false;
        }

        long writeTo(java.io.OutputStream out) throws IOException {
            long added = 0;
            while (skipKnown()) {
                out.write(ArchiveLine.write(stored.event));
                out.write('\n');
                added++;
                stored.advance();
            }
            return added;
        }
    }
}
