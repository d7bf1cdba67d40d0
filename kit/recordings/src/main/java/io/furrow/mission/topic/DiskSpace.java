package io.furrow.mission.topic;

import java.io.IOException;
import java.nio.file.FileStore;
import java.nio.file.Files;
import java.nio.file.Path;

import io.furrow.mission.RecordingDeletedException;

/**
 * Limits writes to a disk, so that a tenth of it and at least 1 GiB stays free for Kafka's logs and the state of jobs,
 * which may be on the same disk.
 *
 * @param reserved bytes that stay free
 */
record DiskSpace(Path folder, long reserved, FreeBytes free) {
    private static final long MIN_FREE_BYTES = 1L << 30;
    private static final int MEBIBYTE = 1 << 20;

    /** Returns the free bytes. */
    interface FreeBytes {
        long get() throws IOException;
    }

    static DiskSpace of(Path folder) throws IOException {
        FileStore disk = Files.getFileStore(folder);
        return new DiskSpace(folder, Math.max(MIN_FREE_BYTES, disk.getTotalSpace() / 10), disk::getUsableSpace);
    }

    /** @throws RecordingDeletedException if the bytes do not fit; a retry would fill the disk again */
    void require(long bytes) throws IOException {
        long now = free.get();
        if (now - bytes < reserved) {
            throw new RecordingDeletedException(
                    "The events do not fit into %s: %d MiB are free there, and %d MiB have to stay free. Play a shorter topic, or give the job a larger folder for temporary files."
                            .formatted(folder, now / MEBIBYTE, reserved / MEBIBYTE));
        }
    }
}
