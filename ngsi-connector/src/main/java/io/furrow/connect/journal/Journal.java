package io.furrow.connect.journal;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * An append-only log of records in preallocated files of one folder. Confirmed records survive a crash of the process
 * and the machine: one thread writes and syncs them in groups. Readers see durable records only. A record is retained
 * until {@link #release} passes it. A file lock ensures that one journal object at a time uses the folder.
 *
 * <p>On opening, incomplete appends are dropped; corruptions of confirmed records are logged, counted and skipped. The
 * folder's name is part of each checksum: a journal may be moved, not renamed.
 */
public final class Journal implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Journal.class);

    private final Path folder;
    private final JournalLock lock;
    private final Segments segments;
    private final Corruptions damages;
    private final JournalQuota room;
    private final SegmentWriter writer;
    private final GroupCommit commit;

    private Journal(Path folder, JournalLock lock, JournalSettings settings, Disk disk) throws IOException {
        this.folder = folder;
        this.lock = lock;
        this.damages = new Corruptions(id());
        this.segments = new Segments(new Recovery(folder, SegmentFormat.saltOf(id()), damages).segments());
        this.room = new JournalQuota(settings, folder, disk, segments);
        this.writer = new SegmentWriter(folder, settings.segmentBytes(), disk, segments);
        this.commit = new GroupCommit(id(), writer, room);
    }

    /**
     * Opens the journal of an existing folder, which may be empty.
     *
     * @return empty if the journal is already open elsewhere
     * @throws UncheckedIOException if the folder cannot be read or locked
     */
    public static Optional<Journal> open(Path folder, JournalSettings settings) {
        return open(folder, settings, Disk.real());
    }

    static Optional<Journal> open(Path folder, JournalSettings settings, Disk disk) {
        try {
            Optional<JournalLock> lock = JournalLock.tryLock(folder);
            if (lock.isEmpty()) {
                return Optional.empty();
            }
            try {
                return Optional.of(new Journal(folder, lock.get(), settings, disk));
            } catch (IOException | RuntimeException | Error e) {
                lock.get().close();
                throw e;
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot open the journal in " + folder, e);
        }
    }

    /** The name of its folder. */
    public String id() {
        return folder.getFileName().toString();
    }

    /** Its folder; files with other names may be stored there and are deleted with it. */
    public Path folder() {
        return folder;
    }

    /**
     * Appends all records, next to each other in one file, or none.
     *
     * @param payloads not empty
     * @return completed when all are durable, failed with a {@link JournalException}; empty if there is no room now
     */
    public Optional<CompletableFuture<Void>> append(List<byte[]> payloads) {
        return commit.append(payloads);
    }

    /** A reader that begins at a sequence number, or at the oldest retained record if that is later. */
    public JournalReader reader(long from) {
        return new JournalReader(segments, SegmentFormat.saltOf(id()), damages, commit, from);
    }

    /** The sequence number after the last durable record. */
    public long end() {
        Segment last = segments.last();
        return Math.max(last == null ? 0 : last.end().sequence(), commit.skippedTo());
    }

    /** The sequence number of the oldest retained record, or {@link #end} if there is none. */
    public long begin() {
        Segment first = segments.first();
        return first == null ? end() : first.base();
    }

    /** Raises the number of the next record to at least this one; only before the first append. */
    public void skipTo(long sequence) {
        commit.skipTo(sequence);
    }

    /** Deletes files whose records are all before a sequence number; the newest file stays. */
    public void release(long below) {
        try {
            segments.release(below);
        } catch (IOException e) {
            LOG.warn("journal {}: cannot delete a segment, will retry", id(), e);
        }
    }

    /** Size of its files. */
    public long bytes() {
        return segments.bytes();
    }

    /** Whether its files use half of the maximum size. */
    public boolean isHalfFull() {
        return room.isHalfFull();
    }

    /** Bytes of records that are not durable yet. */
    public long waitingBytes() {
        return commit.waitingBytes();
    }

    /** The corruptions found since it was opened. */
    public List<Corruption> damages() {
        return damages.all();
    }

    /** The number of records that are missing because of corruptions, as far as it can be determined. */
    public long lostRecords() {
        return damages.records();
    }

    /** Bytes that were skipped because of corruptions or torn appends. */
    public long lostBytes() {
        return damages.bytes();
    }

    /** The error after which it accepts no more appends: the disk failed repeatedly. */
    public Optional<Throwable> failure() {
        return commit.failure();
    }

    /** Makes all appended records durable, accepts no more and unlocks the folder. */
    @Override
    public void close() {
        if (commit.close()) {
            lock.close();
        } else {
            LOG.error("journal {}: the disk does not answer; its folder stays locked by this process", id());
        }
    }

    /** Closes it and deletes its folder. */
    public void delete() {
        try {
            commit.close();
            Path deleted = JournalFolders.markDeleted(folder); // before it is unlocked, so that no task takes it
            close();
            JournalFolders.delete(deleted);
        } catch (IOException e) {
            close();
            LOG.warn("cannot delete the folder {} of an empty journal; delete it manually", folder, e);
        }
    }
}
