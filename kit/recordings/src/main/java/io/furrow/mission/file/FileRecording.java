package io.furrow.mission.file;

import java.io.EOFException;
import java.io.FileNotFoundException;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.NoSuchFileException;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.zip.ZipException;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.UnreadableException;

/** Reads a mission from files; a page that does not follow the last one starts at the beginning of the file or day. */
final class FileRecording implements Recording {
    private final String mission;
    private final RecordingFiles files;
    private final List<List<String>> groups;
    /** The open files; null before the first page and after an error. */
    private ArchiveFiles lines;

    private Cursor position = Cursor.START;
    private Optional<RecordingExtent> span;

    FileRecording(String mission, RecordingFiles files, List<List<String>> groups) {
        this.mission = mission;
        this.files = files;
        this.groups = groups;
    }

    /** The first call reads the whole recording. */
    @Override
    public Optional<RecordingExtent> span() throws RecordingException {
        if (span == null) {
            span = run(this::measureExtent);
        }
        return span;
    }

    private Optional<RecordingExtent> measureExtent() throws IOException {
        RecordingExtent found = null;
        try (ArchiveFiles all = new ArchiveFiles(files, groups)) {
            for (ArchiveFile.Line line = all.peek(); line != null; line = all.peek()) {
                if (line.problem() == null) {
                    long time = line.at().time();
                    found = new RecordingExtent(found == null ? time : found.first(), time);
                }
                all.remove();
                RecordingInterruptedException.check();
            }
        }
        return Optional.ofNullable(found);
    }

    @Override
    public EventPage read(Cursor after, PageLimits limits) throws RecordingException {
        EventPage eventPage = run(() -> {
            if (lines == null || !after.equals(position)) {
                reset();
                lines = new ArchiveFiles(files, groups);
                lines.skipTo(after);
            }
            return page(after, limits);
        });
        position = eventPage.next();
        return eventPage;
    }

    private EventPage page(Cursor after, PageLimits limits) throws IOException {
        List<StoredEvent> events = new ArrayList<>();
        List<SkippedRecords> skipped = new ArrayList<>();
        Cursor next = after;
        int read = 0;
        long bytes = 0;
        ArchiveFile.Line head = lines.peek();
        while (head != null && read < limits.events() && (read == 0 || bytes + head.json().length <= limits.bytes())) {
            read(head, head.at().equals(next), events, skipped);
            read++;
            bytes += head.json().length;
            next = head.at();
            lines.remove();
            head = lines.peek();
        }
        return new EventPage(events, skipped, next, head == null);
    }

    /** @param isDuplicate whether an event of this time and id was just read from another file */
    private static void read(
            ArchiveFile.Line line, boolean isDuplicate, List<StoredEvent> events, List<SkippedRecords> skipped) {
        String reason =
                isDuplicate && line.problem() == null ? "a duplicate of an event in another file" : line.problem();
        if (reason == null) {
            try {
                events.add(ArchiveLine.read(new String(line.json(), StandardCharsets.UTF_8)));
            } catch (UnreadableException e) {
                reason = e.getMessage();
            }
        }
        if (reason != null) {
            skipped.add(new SkippedRecords(line.where(), reason, 1));
        }
    }

    /** Reads from the files. */
    private interface FileAction<T> {
        T run() throws IOException;
    }

    private <T> T run(FileAction<T> action) throws RecordingException {
        try {
            RecordingInterruptedException.check();
            return action.run();
        } catch (RecordingException e) {
            reset();
            throw e;
        } catch (NoSuchFileException | FileNotFoundException e) {
            reset();
            throw new RecordingDeletedException(
                    "A file of mission %s has been deleted: %s".formatted(mission, e.getMessage()));
        } catch (EOFException | ZipException e) {
            reset();
            throw new RecordingDeletedException(
                    "A file of mission %s is damaged or not whole (%s): %s. Export it again."
                            .formatted(mission, groups, e.getMessage()));
        } catch (IOException e) {
            reset();
            throw new RecordingException(
                    "Mission %s cannot be read from %s: %s".formatted(mission, groups, e.getMessage()), e);
        }
    }

    /** Closes the files, so that the next page opens them again. */
    private void reset() {
        ArchiveFiles open = lines;
        lines = null;
        try {
            if (open != null) {
                open.close();
            }
        } catch (IOException e) {
            // The file was only read.
        }
    }

    @Override
    public void close() {
        reset();
    }
}
