package io.furrow.mission.topic;

import java.io.File;
import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.nio.file.StandardWatchEventKinds;
import java.nio.file.WatchKey;
import java.nio.file.WatchService;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class TemporaryFolderTest {
    @TempDir
    Path parent;

    @Test
    void deletesFoldersOfKilledProcessesAndNoOthers() throws Exception {
        Path killed = folder("furrow-topic-1-1-a");
        Path living = folder("furrow-topic-2-2-a");
        Path own = folder(TemporaryFolder.ownPrefix() + "a");
        Path foreign = folder("furrow-1");
        Path fresh = Files.createDirectory(parent.resolve("furrow-topic-3-3-a"));

        try (FileChannel lock = FileChannel.open(living.resolve("lock"), StandardOpenOption.WRITE)) {
            assertThat(lock.tryLock()).isNotNull();
            try (TemporaryFolder created = TemporaryFolder.in(parent)) {
                assertThat(killed).doesNotExist();
                assertThat(parent.toFile().listFiles())
                        .extracting(File::toPath)
                        .containsExactlyInAnyOrder(living, own, foreign, fresh, created.path());
            }
        }
    }

    @Test
    void isLockedUntilItIsDeletedOnClose() throws Exception {
        TemporaryFolder folder = TemporaryFolder.in(parent.resolve("new"));
        Files.createFile(folder.path().resolve("events.ndjson"));

        assertThat(isLocked(folder.path().resolve("lock"))).isTrue();
        folder.close();
        folder.close();

        assertThat(parent.resolve("new")).isEmptyDirectory();
    }

    /** Without the lock, nobody would delete the rest after a kill. */
    @Test
    void deletesTheLockLast() throws Exception {
        TemporaryFolder folder = TemporaryFolder.in(parent);
        Files.createFile(folder.path().resolve("events.ndjson"));
        List<String> deleted = new ArrayList<>();

        try (WatchService changes = parent.getFileSystem().newWatchService()) {
            WatchKey key = folder.path().register(changes, StandardWatchEventKinds.ENTRY_DELETE);
            folder.close();
            do {
                assertThat(changes.poll(10, TimeUnit.SECONDS)).isSameAs(key);
                key.pollEvents().forEach(event -> deleted.add(event.context().toString()));
            } while (key.reset());
        }

        assertThat(deleted).containsExactly("events.ndjson", "lock");
    }

    /** In another process: this one would lose the lock. */
    private static boolean isLocked(Path file) throws IOException, InterruptedException {
        return new ProcessBuilder("python3", "-c", """
                        import fcntl, sys
                        try: fcntl.lockf(open(sys.argv[1], "w"), fcntl.LOCK_EX | fcntl.LOCK_NB)
                        except OSError: sys.exit(3)
                        """, file.toString()).start().waitFor() == 3;
    }

    private Path folder(String name) throws IOException {
        Path folder = Files.createDirectory(parent.resolve(name));
        Files.createFile(folder.resolve("lock"));
        Files.createFile(folder.resolve("events.ndjson"));
        return folder;
    }
}
