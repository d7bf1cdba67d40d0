package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.util.Optional;

import static java.nio.file.StandardOpenOption.CREATE;
import static java.nio.file.StandardOpenOption.WRITE;

/** The disk operations that a journal needs for writing; tests replace it by a failing one. */
interface Disk {
    /** A segment file that is being written. */
    interface SegmentFile extends AutoCloseable {
        /** Writes all of {@code bytes} at a position. */
        void write(ByteBuffer bytes, long position) throws IOException;

        /** Returns when everything written is on the disk. */
        void sync() throws IOException;

        @Override
        void close() throws IOException;
    }

    /**
     * Creates a file of {@code capacity} bytes, zeros after the header, replacing an existing one. When this returns,
     * file and name are on the disk.
     */
    SegmentFile create(Path file, ByteBuffer header, long capacity) throws IOException;

    /** Announces that a file of this capacity will be created in the folder, so that it can be preallocated. */
    default void prepare(Path folder, long capacity) {}

    /** Announces that no further file will be created. */
    default void close() {}

    /** Bytes that can still be written on the disk that holds the folder. */
    long usable(Path folder) throws IOException;

    /** The real disk. */
    static Disk real() {
        return new FileDisk();
    }

    /** Writes all of {@code bytes} at a position. */
    static void writeFully(FileChannel channel, ByteBuffer bytes, long position) throws IOException {
        long at = position;
        while (bytes.hasRemaining()) {
            at += channel.write(bytes, at);
        }
    }

    /** Files through {@link FileChannel}. */
    final class FileDisk implements Disk {
        private static final int ZEROS_AT_ONCE = 1024 * 1024;
        /** Recovery deletes files with its suffix. */
        private static final String SPARE = "spare.segment.tmp";

        private final SpareFile spare = new SpareFile();

        @Override
        public void prepare(Path folder, long capacity) {
            spare.make(folder.resolve(SPARE), capacity);
        }

        @Override
        public SegmentFile create(Path file, ByteBuffer header, long capacity) throws IOException {
            Optional<Path> ready = spare.take(capacity);
            Path temporary = ready.orElse(file.resolveSibling(file.getFileName() + ".tmp"));
            try (FileChannel channel = FileChannel.open(temporary, CREATE, WRITE)) {
                if (ready.isEmpty()) {
                    writeZeros(channel, capacity);
                }
                writeFully(channel, header, 0);
                channel.force(true);
            } catch (IOException e) {
                Files.deleteIfExists(temporary);
                throw e;
            }
            Files.move(temporary, file, StandardCopyOption.ATOMIC_MOVE);
            DurableFiles.syncFolder(file.getParent());
            return new ChannelFile(FileChannel.open(file, StandardOpenOption.WRITE));
        }

        private static void writeZeros(FileChannel channel, long capacity) throws IOException {
            channel.truncate(0);
            ByteBuffer zeros = ByteBuffer.allocateDirect(ZEROS_AT_ONCE);
            for (long at = 0; at < capacity; at += ZEROS_AT_ONCE) {
                writeFully(channel, zeros.clear().limit((int) Math.min(ZEROS_AT_ONCE, capacity - at)), at);
            }
        }

        @Override
        public void close() {
            spare.discard();
        }

        @Override
        public long usable(Path folder) throws IOException {
            return Files.getFileStore(folder).getUsableSpace();
        }
    }

    /** A file behind a channel. */
    record ChannelFile(FileChannel channel) implements SegmentFile {
        @Override
        public void write(ByteBuffer bytes, long position) throws IOException {
            Disk.writeFully(channel, bytes, position);
        }

        @Override
        public void sync() throws IOException {
            channel.force(false);
        }

        @Override
        public void close() throws IOException {
            channel.close();
        }
    }
}
