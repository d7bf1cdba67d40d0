package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.Optional;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Locks a folder for one owner, also among several owners in one process and among copies of this class in several
 * class loaders. The operating system releases it with the process. The owner locks two bytes of the lock file: the
 * first one decides ownership. A query touches only the second one and never blocks an owner.
 */
final class JournalLock implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(JournalLock.class);

    private static final String FILE = "lock";
    private static final long OWNER = 0;
    private static final long PRESENCE = 1;
    private static final String PROPERTY = "io.furrow.journal.lock.";
    private static final String HELD = "held";
    private static final String ASKED = "asked";

    private final String property;
    private final FileChannel channel;

    private JournalLock(String property, FileChannel channel) {
        this.property = property;
        this.channel = channel;
    }

    /** The lock, or empty if it is held. */
    static Optional<JournalLock> tryLock(Path folder) throws IOException {
        String property = PROPERTY + folder.toRealPath();
        if (!reserve(property, HELD)) {
            return Optional.empty();
        }
        FileChannel channel = null;
        JournalLock lock = null;
        try {
            channel = FileChannel.open(folder.resolve(FILE), StandardOpenOption.CREATE, StandardOpenOption.WRITE);
            if (channel.tryLock(OWNER, 1, false) != null) {
                while (channel.tryLock(PRESENCE, 1, false) == null) {
                    Thread.yield(); // another process is querying it
                }
                lock = new JournalLock(property, channel);
            }
        } catch (OverlappingFileLockException e) {
            LOG.debug("{} is locked in this process", folder, e);
        } finally {
            if (lock == null) {
                give(property, channel);
            }
        }
        return Optional.ofNullable(lock);
    }

    /** Whether the lock is held. */
    static boolean isHeld(Path folder) throws IOException {
        String property = PROPERTY + folder.toRealPath();
        if (!reserve(property, ASKED)) {
            return true;
        }
        try (FileChannel channel = FileChannel.open(folder.resolve(FILE), StandardOpenOption.READ)) {
            return channel.tryLock(PRESENCE, 1, true) == null;
        } catch (NoSuchFileException e) {
            return false;
        } catch (OverlappingFileLockException e) {
            return true;
        } finally {
            System.getProperties().remove(property);
        }
    }

    /**
     * Whether this part of the process may open the lock file, which no other part may do then: closing any channel of a
     * file drops the process's locks on it. All class loaders share the system properties, and no other map.
     */
    private static boolean reserve(String property, String use) {
        Object other = System.getProperties().putIfAbsent(property, use);
        while (ASKED.equals(other)) {
            Thread.yield();
            other = System.getProperties().putIfAbsent(property, use);
        }
        return other == null;
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
