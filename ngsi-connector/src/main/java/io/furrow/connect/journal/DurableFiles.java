package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;

import static java.nio.file.StandardOpenOption.READ;
import static java.nio.file.StandardOpenOption.WRITE;

/** Makes files and their names survive a power cut. */
public final class DurableFiles {
    private DurableFiles() {}

    /** Returns when everything that was written to the file is on the disk, by whichever channel. */
    public static void sync(Path file) throws IOException {
        try (FileChannel channel = FileChannel.open(file, WRITE)) {
            channel.force(true);
        }
    }

    /** Makes a new or vanished name in the folder durable; file systems that cannot do that do not need it. */
    static void syncFolder(Path folder) throws IOException {
        if (!System.getProperty("os.name").startsWith("Windows")) {
            try (FileChannel channel = FileChannel.open(folder, READ)) {
                channel.force(true);
            }
        }
    }

    /** Replaces a file as a whole: after a power cut it has its old content or that of the other file. */
    public static void replace(Path file, Path next) throws IOException {
        sync(next);
        Files.move(next, file, StandardCopyOption.REPLACE_EXISTING, StandardCopyOption.ATOMIC_MOVE);
        syncFolder(file.toAbsolutePath().getParent());
    }
}
