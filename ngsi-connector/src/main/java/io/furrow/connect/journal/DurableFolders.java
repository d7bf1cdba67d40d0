package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileStore;
import java.nio.file.Files;
import java.nio.file.Path;

/** Makes folders whose names survive the machine: a name is durable when the folder that holds it was synced. */
final class DurableFolders {
    /** Makes the names in a folder durable. */
    interface Sync {
        void of(Path folder) throws IOException;
    }

    private DurableFolders() {}

    /**
     * Makes a folder and those above it that are missing, and syncs all above it up to the root of its file system. A process
     * that ended in between may have left any of them unsynced. One that may not be read was there before.
     */
    static void create(Path folder, Sync sync) throws IOException {
        Files.createDirectories(folder);
        FileStore store = Files.getFileStore(folder);
        Path above = folder.toAbsolutePath().getParent();
        try {
            while (above != null && Files.getFileStore(above).equals(store)) {
                sync.of(above);
                above = above.getParent();
            }
        } catch (AccessDeniedException e) {
            // Nothing was made there: to make a folder needs more rights than to read.
            return;
        }
    }
}
