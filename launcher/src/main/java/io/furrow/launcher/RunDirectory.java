package io.furrow.launcher;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.channels.FileChannel;
import java.nio.channels.FileLock;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Stream;

/** The directory of one running suite, locked against a second one; a temporary one is deleted when it is closed. */
final class RunDirectory implements AutoCloseable {
    private final Path path;
    private final boolean temporary;
    private final FileChannel lock;

    private RunDirectory(Path path, boolean temporary, FileChannel lock) {
        this.path = path;
        this.temporary = temporary;
        this.lock = lock;
    }

    /**
     * @param kept null for a temporary directory
     * @throws SuiteNotStartedException if it cannot be written or another suite uses it
     */
    static RunDirectory open(Path kept) {
        try {
            Path path = kept == null
                    ? Files.createTempDirectory("furrow-")
                    : Files.createDirectories(kept.toAbsolutePath());
            return new RunDirectory(path, kept == null, lock(path));
        } catch (IOException e) {
            throw new SuiteNotStartedException(
                    "Cannot write in %s (%s). Name a directory that you may write with --data."
                            .formatted(kept == null ? System.getProperty("java.io.tmpdir") : kept, e.getMessage()),
                    e);
        }
    }

    Path path() {
        return path;
    }

    Path resolve(String name) {
        return path.resolve(name);
    }

    boolean isTemporary() {
        return temporary;
    }

    @Override
    public void close() {
        try {
            lock.close();
            if (temporary) {
                delete();
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot delete " + path, e);
        }
    }

    private static FileChannel lock(Path directory) throws IOException {
        FileChannel channel =
                FileChannel.open(directory.resolve("lock"), StandardOpenOption.CREATE, StandardOpenOption.WRITE);
        FileLock lock;
        try {
            lock = channel.tryLock();
        } catch (OverlappingFileLockException e) {
            lock = null; // held by this very process
        }
        if (lock == null) {
            channel.close();
            throw new SuiteNotStartedException(
                    "Another Furrow uses " + directory + ". Stop it, or name another directory with --data.");
        }
        return channel;
    }

    private void delete() throws IOException {
        List<Path> deepestFirst;
        try (Stream<Path> all = Files.walk(path)) {
            deepestFirst = all.sorted(Comparator.reverseOrder()).toList();
        }
        for (Path one : deepestFirst) {
            Files.deleteIfExists(one);
        }
    }
}
