package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.channels.FileLock;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Optional;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Keeps a folder for one owner, also among several in one process and among copies of this class in several class loaders.
 * The operating system ends it with the process.
 */
final class JournalLock implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(JournalLock.class);

    private static final String FILE = "lock";
    private static final String PROPERTY = "io.furrow.journal.lock.";

    private final String property;
    private final FileChannel channel;

    private JournalLock(String property, FileChannel channel) {
        this.property = property;
        this.channel = channel;
    }

    /** The lock, or empty if somebody has it. */
    static Optional<JournalLock> tryLock(Path folder) throws IOException {
        // The system properties are the one map that all class loaders share. The file must not even be opened while
        // another
        // part of this process has it locked: to close any channel of a file drops the process's lock on it.
        String property = PROPERTY + folder.toRealPath();
        if (System.getProperties().putIfAbsent(property, "held") != null) {
            return Optional.empty();
        }
        FileChannel channel = null;
        try {
            channel = FileChannel.open(folder.resolve(FILE), StandardOpenOption.CREATE, StandardOpenOption.WRITE);
            FileLock lock = channel.tryLock();
            if (lock != null) {
                return Optional.of(new JournalLock(property, channel));
            }
        } catch (OverlappingFileLockException e) {
            LOG.debug("{} is locked in this process", folder, e);
        } catch (IOException | RuntimeException e) {
            give(property, channel);
            throw e;
        }
        give(property, channel);
        return Optional.empty();
    }

    private static void give(String property, FileChannel channel) {
        try {
            if (channel != null) {
                channel.close();
            }
        } catch (IOException e) {
            LOG.warn("cannot close the lock file of {}", property, e);
        }
        System.getProperties().remove(property);
    }

    @Override
    public void close() {
        if (channel.isOpen()) {
            give(property, channel);
        }
    }
}
