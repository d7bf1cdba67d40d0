package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.AccessDeniedException;
import java.nio.file.FileStore;
import java.nio.file.Files;
import java.nio.file.Path;

/** Creates folders whose names survive a crash of the machine: a name is durable once its parent folder was synced. */
final class DurableFolders {
    /** Makes the names in a folder durable. */
    interface Sync {
        void of(Path folder) throws IOException;
    }

    private DurableFolders() {}

    /**
     * Creates a folder and its missing parents, and syncs all parents up to the root of the file system: a process that
     * died may have left any of them unsynced. An unreadable parent existed before.
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
            // Nothing was created there: creating a folder needs more rights than reading.
            return;
        }
    }
}
