package io.furrow.mission.topic;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.channels.FileChannel;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.DirectoryStream;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.time.Instant;
import java.util.Comparator;
import java.util.stream.Stream;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * A folder that is deleted on close, or, if its process was killed, when another is created in the same place. A lock
 * shows that its process lives.
 */
final class TemporaryFolder implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TemporaryFolder.class);
    private static final String PREFIX = "furrow-topic-";
    private static final String LOCK = "lock";

    private final Path path;
    private final FileChannel lock;

    private TemporaryFolder(Path path, FileChannel lock) {
        this.path = path;
        this.lock = lock;
    }

    /** @param parent is created if it does not exist */
    static TemporaryFolder in(Path parent) throws IOException {
        Files.createDirectories(parent);
        deleteAbandoned(parent);
        Path path = Files.createTempDirectory(parent, ownPrefix());
        Path file = path.resolve("new-lock");
        FileChannel lock = FileChannel.open(file, StandardOpenOption.CREATE_NEW, StandardOpenOption.WRITE);
        try {
            lock.lock();
        } catch (IOException e) {
            LOG.debug("{} has no locks, so nobody deletes {} after a kill", parent, path, e);
        }
        Files.move(file, path.resolve(LOCK)); // under this name other processes try to lock it
        return new TemporaryFolder(path, lock);
    }

    Path path() {
        return path;
    }

    @Override
    public void close() {
        if (!lock.isOpen()) {
            return;
        }
        try (lock) {
            delete(path);
        } catch (IOException e) {
            LOG.warn("The temporary folder {} cannot be deleted; delete it", path, e);
        }
    }

    /**
     * The prefix of this process. Its folders are never examined: to close a second channel of a lock file would release
     * the process's lock. In containers, several processes have the same number.
     */
    static String ownPrefix() {
        ProcessHandle self = ProcessHandle.current();
        return PREFIX
                + self.pid()
                + '-'
                + self.info().startInstant().map(Instant::toEpochMilli).orElse(0L)
                + '-';
    }

    private static void deleteAbandoned(Path parent) throws IOException {
        try (DirectoryStream<Path> folders = Files.newDirectoryStream(parent, PREFIX + '*')) {
            for (Path folder : folders) {
                if (!folder.getFileName().toString().startsWith(ownPrefix())) {
                    deleteIfAbandoned(folder);
                }
            }
        }
    }

    private static void deleteIfAbandoned(Path folder) {
        try (FileChannel lock = FileChannel.open(folder.resolve(LOCK), StandardOpenOption.WRITE)) {
            if (lock.tryLock() != null) {
                delete(folder);
                LOG.info("deleted {} of a process that was killed", folder);
            }
        } catch (NoSuchFileException | OverlappingFileLockException e) {
            LOG.debug("{} is just created or deleted", folder, e);
        } catch (IOException e) {
            LOG.info("cannot delete {}: {}", folder, e.toString());
        }
    }

    /** Deletes the lock last: without it, nobody would delete the rest after a kill. */
    private static void delete(Path folder) throws IOException {
        Path lock = folder.resolve(LOCK);
        try (Stream<Path> found = Files.walk(folder)) {
            for (Path path : found.sorted(Comparator.reverseOrder()).toList()) {
                if (!path.equals(lock) && !path.equals(folder)) {
                    Files.deleteIfExists(path);
                }
            }
        } catch (UncheckedIOException e) {
            throw e.getCause();
        }
        Files.deleteIfExists(lock);
        Files.deleteIfExists(folder);
    }
}
