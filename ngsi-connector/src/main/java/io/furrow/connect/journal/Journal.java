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
 * An append-only log of records in preallocated files of one folder. What {@link #append} confirms survives the process and
 * the machine: records are written and synced in groups by one thread. Readers see durable records only. A record is kept
 * until {@link #release} passes it. One journal object at a time has the folder, by a file lock.
 *
 * <p>When it is opened, an append that had not ended is dropped; damage in what had been confirmed is logged, counted and
 * passed over. The folder's name is part of each checksum: a journal may be moved, not renamed.
 */
public final class Journal implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Journal.class);

    private final Path folder;
    private final JournalLock lock;
    private final Segments segments;
    private final Damages damages;
    private final Room room;
    private final SegmentWriter writer;
    private final GroupCommit commit;

    private Journal(Path folder, JournalLock lock, JournalSettings settings, Disk disk) throws IOException {
        this.folder = folder;
        this.lock = lock;
        this.damages = new Damages(id());
        this.segments = new Segments(new Recovery(folder, SegmentFormat.saltOf(id()), damages).segments());
        this.room = new Room(settings, folder, disk, segments);
        this.writer = new SegmentWriter(folder, settings.segmentBytes(), disk, segments);
        this.commit = new GroupCommit(id(), writer, room);
    }

    /**
     * Opens the journal of an existing folder, which may be empty.
     *
     * @return empty if somebody has it open
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

    /** Its folder; files with other names than its own may be kept there, they go with it. */
    public Path folder() {
        return folder;
    }

    /**
     * Appends all records, next to each other in one file, or none.
     *
     * @param payloads none of them empty
     * @return completed when all are durable, failed with a {@link JournalException}; empty if there is no room now
     */
    public Optional<CompletableFuture<Void>> append(List<byte[]> payloads) {
        return commit.append(payloads);
    }

    /** A reader that begins at a sequence number, or at the oldest record that is kept if that is later. */
    public JournalReader reader(long from) {
        return new JournalReader(segments, SegmentFormat.saltOf(id()), damages, commit, from);
    }

    /** The sequence number behind the last durable record. */
    public long end() {
        Segment last = segments.last();
        return Math.max(last == null ? 0 : last.end().sequence(), commit.skippedTo());
    }

    /** The sequence number of the oldest record that is kept, or {@link #end} if none is. */
    public long begin() {
        Segment first = segments.first();
        return first == null ? end() : first.base();
    }

    /** Gives the next record at least this number; only before the first append. */
    public void skipTo(long sequence) {
        commit.skipTo(sequence);
    }

    /** Deletes files that hold only records before a sequence number; the newest file stays. */
    public void release(long below) {
        try {
            segments.release(below);
        } catch (IOException e) {
            LOG.warn("journal {}: cannot delete a segment, will try again", id(), e);
        }
    }

    /** Bytes that its files take on the disk. */
    public long bytes() {
        return segments.bytes();
    }

    /** Bytes of records that are not durable yet. */
    public long waitingBytes() {
        return commit.waitingBytes();
    }

    /** What could not be read since it was opened. */
    public List<Damage> damages() {
        return damages.all();
    }

    /** How many records are known to be missing because of damages. */
    public long lostRecords() {
        return damages.records();
    }

    /** Bytes that were skipped because of damages or torn appends. */
    public long lostBytes() {
        return damages.bytes();
    }

    /** The error because of which it takes nothing any more: the disk failed again and again. */
    public Optional<Throwable> failure() {
        return commit.failure();
    }

    /** Makes durable what was appended, takes nothing more and lets others open the folder. */
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
        close();
        try {
            JournalFolders.delete(folder);
        } catch (IOException e) {
            LOG.warn("cannot delete the folder {} of a journal that holds nothing any more", folder, e);
        }
    }
}
