package io.furrow.ingest.image;

import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.file.FileSystems;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;

/** A folder of the local file system. */
final class LocalFolder {
    /** On other systems a folder cannot be opened, and syncing names is not necessary. */
    private static final boolean IS_POSIX =
            FileSystems.getDefault().supportedFileAttributeViews().contains("posix");

    private LocalFolder() {}

    /** Syncs the names in it to the disk. */
    static void sync(Path folder) throws IOException {
        if (IS_POSIX) {
            try (FileChannel channel = FileChannel.open(folder, StandardOpenOption.READ)) {
                channel.force(true);
            }
        }
    }
}
