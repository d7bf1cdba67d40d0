package io.furrow.mission.file;

import java.io.IOException;
import java.time.LocalDate;
import java.time.ZoneOffset;
import java.time.format.DateTimeParseException;
import java.util.Comparator;
import java.util.List;
import java.util.PriorityQueue;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingInterruptedException;

/** Reads the lines of files in the order of events: group after group, those of a group merged; from a cursor on. */
final class ArchiveFiles implements AutoCloseable {
    static final int LENGTH_OF_DAY = "2026-11-21".length();

    /** A file whose next line is known. */
    private record Head(ArchiveFile.Line line, int part, ArchiveFile file) {}

    private final RecordingFiles files;
    private final List<List<String>> groups;
    private final PriorityQueue<Head> heads = new PriorityQueue<>(
            Comparator.comparing((Head head) -> head.line().at()).thenComparing(Head::part));
    private int nextGroup;
    private Cursor last = Cursor.START;

    /** @param groups files whose times overlap lie in one */
    ArchiveFiles(RecordingFiles files, List<List<String>> groups) {
        this.files = files;
        this.groups = groups;
    }

    /** Continues to the first line after a cursor; nothing is open yet. A file alone may bear a date and hold several days. */
    void skipTo(Cursor after) throws IOException {
        while (groups.size() > 1 && nextGroup < groups.size() && isBefore(groups.get(nextGroup), after)) {
            nextGroup++;
        }
        boolean skips = after.compareTo(Cursor.START) > 0;
        while (skips && peek() != null && peek().at().compareTo(after) <= 0) {
            remove();
            RecordingInterruptedException.check();
        }
    }

    /** Whether an archive's day is over before the cursor. */
    private static boolean isBefore(List<String> group, Cursor after) {
        String name = group.get(0).substring(group.get(0).lastIndexOf('/') + 1);
        if (name.length() < LENGTH_OF_DAY) {
            return false;
        }
        try {
            LocalDate day = LocalDate.parse(name.substring(0, LENGTH_OF_DAY));
            return day.plusDays(1).atStartOfDay(ZoneOffset.UTC).toInstant().toEpochMilli() <= after.time();
        } catch (DateTimeParseException e) {
            return false;
        }
    }

    /** The next line, which stays the next; null at the end. */
    ArchiveFile.Line peek() throws IOException {
        while (heads.isEmpty() && nextGroup < groups.size()) {
            List<String> group = groups.get(nextGroup++);
            for (int part = 0; part < group.size(); part++) {
                advance(part, new ArchiveFile(files, group.get(part)));
            }
        }
        if (heads.isEmpty()) {
            return null;
        }
        ArchiveFile.Line line = heads.peek().line();
        if (line.broken() == null && line.at().compareTo(last) < 0) {
            throw new RecordingDeletedException(
                    "%s is out of order: files before this one hold later events".formatted(line.where()));
        }
        return line;
    }

    /** Continues after {@link #peek}. */
    void remove() throws IOException {
        Head head = heads.remove();
        last = head.line().broken() == null ? head.line().at() : last;
        advance(head.part(), head.file());
    }

    private void advance(int part, ArchiveFile file) throws IOException {
        ArchiveFile.Line line;
        try {
            line = file.next();
        } catch (IOException e) {
            file.close();
            throw e;
        }
        if (line == null) {
            file.close();
        } else {
            heads.add(new Head(line, part, file));
        }
    }

    @Override
    public void close() throws IOException {
        for (Head head : heads) {
            head.file().close();
        }
        heads.clear();
    }
}
