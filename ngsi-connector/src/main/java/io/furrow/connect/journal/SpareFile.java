package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import static java.nio.file.StandardOpenOption.CREATE;
import static java.nio.file.StandardOpenOption.TRUNCATE_EXISTING;
import static java.nio.file.StandardOpenOption.WRITE;

/**
 * Preallocates a file of zeros in the background, so that no append waits for the next segment. It leaves half of the
 * disk time to others until the file is needed. Not thread-safe.
 */
final class SpareFile {
    private static final Logger LOG = LoggerFactory.getLogger(SpareFile.class);
    private static final int PIECE = 1024 * 1024;

    private Path file;
    private long capacity;
    private CompletableFuture<Boolean> made;
    private volatile boolean hurry;
    private volatile boolean undesired;

    /** Begins to create the file, unless there is one already. */
    void make(Path path, long bytes) {
        if (made != null) {
            return;
        }
        file = path;
        capacity = bytes;
        hurry = false;
        undesired = false;
        made = CompletableFuture.supplyAsync(() -> write(path, bytes), SpareFile::onThread)
                .exceptionally(failure -> {
                    LOG.debug("{} could not be preallocated", path, failure);
                    return false;
                });
    }

    private static void onThread(Runnable task) {
        Thread thread = new Thread(task, "journal-spare");
        thread.setDaemon(true);
        thread.start();
    }

    /** The file if one of this size could be created; the caller then owns it. */
    Optional<Path> take(long bytes) {
        if (made == null || capacity != bytes) {
            return Optional.empty();
        }
        hurry = true;
        boolean whole = made.join();
        made = null;
        return whole ? Optional.of(file) : Optional.empty();
    }

    /** Deletes the file. */
    void discard() {
        if (made == null) {
            return;
        }
        undesired = true;
        made.join();
        made = null;
        try {
            Files.deleteIfExists(file);
        } catch (IOException e) {
            LOG.debug("{} stays until the journal is opened again", file, e);
        }
    }

    /** Returns whether the file is complete; otherwise the segment is created on demand, which reports the error. */
    private boolean write(Path path, long bytes) {
        try (FileChannel channel = FileChannel.open(path, CREATE, TRUNCATE_EXISTING, WRITE)) {
            ByteBuffer zeros = ByteBuffer.allocateDirect((int) Math.min(PIECE, bytes));
            for (long at = 0; at < bytes && !undesired; at += PIECE) {
                long start = System.nanoTime();
                Disk.writeFully(channel, zeros.clear().limit((int) Math.min(PIECE, bytes - at)), at);
                channel.force(false);
                if (!hurry) {
                    Thread.sleep(Duration.ofNanos(System.nanoTime() - start).toMillis());
                }
            }
            return !undesired;
        } catch (IOException e) {
            LOG.debug("{} could not be preallocated", path, e);
            return false;
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return false;
        }
    }
}
