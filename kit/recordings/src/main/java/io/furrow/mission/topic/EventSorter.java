package io.furrow.mission.topic;

import java.io.BufferedOutputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.Deque;
import java.util.List;
import java.util.PriorityQueue;

import io.furrow.mission.RecordingInterruptedException;

/**
 * Sorts events on disk: writes sorted runs of limited size, then merges them. Of events with the same time and id, the
 * first by partition and offset counts.
 */
final class EventSorter {
    private static final int MAX_MERGED = 64;
    /** Free space is checked before each step of this size. */
    private static final long STEP_BYTES = 8L * 1024 * 1024;

    private final DiskSpace diskSpace;
    private final long maxBytes;
    private final List<SortedEvent> events = new ArrayList<>();
    private long bytes;
    private final Deque<Path> runs = new ArrayDeque<>();
    private int files;

    /** Accepts events in their order. */
    private interface Output {
        void write(SortedEvent event) throws IOException;
    }

    /**
     * @param diskSpace folder of its files; the caller deletes them
     * @param maxBytes approximate maximum of events in memory
     */
    EventSorter(DiskSpace diskSpace, long maxBytes) {
        this.diskSpace = diskSpace;
        this.maxBytes = maxBytes;
    }

    void add(SortedEvent event) throws IOException {
        events.add(event);
        bytes += event.bytes();
        if (bytes >= maxBytes) {
            writeRun();
        }
    }

    private void writeRun() throws IOException {
        diskSpace.require(bytes);
        events.sort(SortedEvent.ORDER);
        Path run = nextFile();
        try (DataOutputStream out = SortedRun.create(run)) {
            for (SortedEvent event : events) {
                SortedRun.write(event, out);
            }
            SortedRun.end(out);
        }
        runs.add(run);
        events.clear();
        bytes = 0;
    }

    private Path nextFile() {
        return diskSpace.folder().resolve("run-" + files++);
    }

    /** Writes the lines of all events in order. */
    void writeLines(Path file) throws IOException {
        writeRun();
        while (runs.size() > MAX_MERGED) {
            mergeSome();
        }
        try (OutputStream lines = new BufferedOutputStream(Files.newOutputStream(file))) {
            merge(List.copyOf(runs), event -> {
                lines.write(event.line());
                lines.write('\n');
            });
        }
        runs.clear();
    }

    private void mergeSome() throws IOException {
        List<Path> some = new ArrayList<>();
        while (some.size() < MAX_MERGED) {
            some.add(runs.remove());
        }
        Path merged = nextFile();
        try (DataOutputStream out = SortedRun.create(merged)) {
            merge(some, event -> SortedRun.write(event, out));
            SortedRun.end(out);
        }
        runs.add(merged);
    }

    /** Merges files and deletes them. */
    private void merge(List<Path> some, Output output) throws IOException {
        PriorityQueue<SortedRun> heads = new PriorityQueue<>(Comparator.comparing(SortedRun::peek, SortedEvent.ORDER));
        List<SortedRun> open = new ArrayList<>();
        try {
            for (Path file : some) {
                SortedRun run = new SortedRun(file);
                open.add(run);
                if (run.peek() != null) {
                    heads.add(run);
                }
            }
            merge(heads, output);
        } finally {
            for (SortedRun run : open) {
                run.close();
            }
        }
        for (Path file : some) {
            Files.delete(file);
        }
    }

    private void merge(PriorityQueue<SortedRun> heads, Output output) throws IOException {
        SortedEvent last = null;
        long allowed = 0;
        while (!heads.isEmpty()) {
            RecordingInterruptedException.check();
            SortedRun run = heads.remove();
            SortedEvent next = run.peek();
            if (last == null || !next.at().equals(last.at())) {
                if (allowed < next.bytes()) {
                    allowed = Math.max(STEP_BYTES, next.bytes());
                    diskSpace.require(allowed);
                }
                allowed -= next.bytes();
                output.write(next);
                last = next;
            }
            run.remove();
            if (run.peek() != null) {
                heads.add(run);
            }
        }
    }
}
