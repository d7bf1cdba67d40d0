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

/** Reads the lines of files in the order of events: one group after the other, each merged. */
final class ArchiveFiles implements AutoCloseable {
    static final int LENGTH_OF_DAY = "2026-11-21".length();

    /** A file and its next line. */
    private record Head(ArchiveFile.Line line, int part, ArchiveFile file) {}

    private final RecordingFiles files;
    private final List<List<String>> groups;
    private final PriorityQueue<Head> heads = new PriorityQueue<>(
            Comparator.comparing((Head head) -> head.line().at()).thenComparing(Head::part));
    private int nextGroup;
    private Cursor last = Cursor.START;

    /** @param groups files with overlapping times are in one group */
    ArchiveFiles(RecordingFiles files, List<List<String>> groups) {
        this.files = files;
        this.groups = groups;
    }

    /**
     * Continues to the first line after a cursor, before any file is open. Days are skipped by file name only if there
     * are several groups, because a single file may have a date in its name and contain several days.
     */
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

    /** Returns whether the day of a group ends before the cursor. */
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

    /** Returns the next line without consuming it; null at the end. */
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
        if (line.problem() == null && line.at().compareTo(last) < 0) {
            throw new RecordingDeletedException(
                    "%s is out of order: files before this one hold later events".formatted(line.where()));
        }
        return line;
    }

    /** Consumes the line of {@link #peek}. */
    void remove() throws IOException {
        Head head = heads.remove();
        last = head.line().problem() == null ? head.line().at() : last;
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
