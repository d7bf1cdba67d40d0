package io.furrow.connect.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.atomic.AtomicBoolean;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static io.furrow.connect.journal.JournalTest.append;
import static org.assertj.core.api.Assertions.assertThat;

class JournalFoldersTest {
    private static final JournalSettings SMALL = new JournalSettings(64 * 1024, 4 * 1024, 8 * 1024, 0);

    @TempDir
    private Path root;

    @Test
    void takesTheJournalOfTheSlotAgain() throws Exception {
        String first;
        try (Journal journal = folders("farm").take(0)) {
            first = journal.id();
            append(journal, "kept");
            try (Journal other = folders("farm").take(1)) {
                assertThat(other.id()).startsWith("1-");
            }
        }
        try (Journal journal = folders("farm").take(0)) {
            assertThat(journal.id()).isEqualTo(first).matches("0-[0-9a-f]{16}");
            assertThat(JournalTest.read(journal.reader(0))).containsExactly("0 kept");
        }
    }

    @Test
    void makesAnotherWhenTheOneOfTheSlotIsInUse() {
        try (Journal one = folders("farm").take(0);
                Journal two = folders("farm").take(0)) {
            assertThat(one.id()).isNotEqualTo(two.id());
        }
    }

    @Test
    void adoptsWhatNobodyHasOpen() throws Exception {
        String left;
        try (Journal journal = folders("farm").take(3)) {
            left = journal.id();
            append(journal, "left");
        }
        folders("other").take(0).close();
        try (Journal own = folders("farm").take(0)) {
            List<Journal> adopted = adopted("farm");
            assertThat(adopted).extracting(Journal::id).containsExactly(left);
            assertThat(adopted("farm")).isEmpty();
            assertThat(own.id()).isNotEqualTo(left);
            adopted.get(0).delete();
            assertThat(root.resolve("farm").resolve(left)).doesNotExist();
        }
    }

    /** Else a record may be confirmed in a journal whose files are deleted the moment after. */
    @Tag("full")
    @Test
    void deletesNoJournalThatATaskHasTaken() throws Exception {
        AtomicBoolean ended = new AtomicBoolean();
        CompletableFuture<Void> deleting = CompletableFuture.runAsync(() -> {
            while (!ended.get()) {
                adopted("farm").forEach(Journal::delete);
            }
        });
        try {
            for (int i = 0; i < 100; i++) {
                try (Journal journal = folders("farm").take(0)) {
                    append(journal, "confirmed");
                    assertThat(journal.folder()).isDirectoryContaining("regex:.*\\d{19}.*");
                }
            }
        } finally {
            ended.set(true);
            deleting.join();
        }
        assertThat(Files.list(root.resolve("farm")).map(Path::toString)).noneMatch(name -> name.contains("deleted-"));
    }

    @Test
    void leavesFoldersAloneThatAreNoJournals() throws Exception {
        Path other = Files.createDirectories(root.resolve("farm").resolve("notes"));

        assertThat(adopted("farm")).isEmpty();
        assertThat(other).isEmptyDirectory();
    }

    @Test
    void listsWhatNobodyHasOpenAndHoldsSomething() throws Exception {
        try (Journal open = folders("farm").take(0)) {
            append(open, "in use");
            try (Journal gone = folders("gone farm/1").take(0)) {
                append(gone, "left");
            }
            folders("empty").take(0).close();

            assertThat(folders("farm").orphans()).singleElement().satisfies(orphan -> {
                assertThat(orphan.owner()).isEqualTo("gone%20farm%2F1");
                assertThat(orphan.bytes()).isPositive();
            });
        }
        assertThat(folders("farm").orphans()).hasSize(2);
    }

    @Tag("full")
    @Test
    void takesTheJournalOfTheSlotWhileOthersLookForOrphans() throws Exception {
        String id;
        try (Journal journal = folders("farm").take(0)) {
            id = journal.id();
            append(journal, "left");
        }
        AtomicBoolean ended = new AtomicBoolean();
        CompletableFuture<Void> looking = CompletableFuture.runAsync(() -> {
            while (!ended.get()) {
                folders("another").orphans();
            }
        });
        try {
            for (int i = 0; i < 200; i++) {
                try (Journal journal = folders("farm").take(0)) {
                    assertThat(journal.id()).isEqualTo(id);
                }
            }
        } finally {
            ended.set(true);
            looking.join();
        }
    }

    @Test
    void keepsOwnersWithStrangeNamesInTheRoot() {
        for (String owner : List.of("..", ".", "a/b", "a\\b", "ä", "%2F", "a b")) {
            try (Journal journal = folders(owner).take(0)) {
                assertThat(journal.folder().getParent().getParent()).isEqualTo(root);
                assertThat(Files.isDirectory(journal.folder())).isTrue();
            }
        }
        assertThat(JournalFolders.folderName("ngsi-source")).isEqualTo("ngsi-source");
    }

    @Test
    void makesEachNameDurableUpToTheRootOfTheFileSystem() throws Exception {
        List<Path> synced = new ArrayList<>();
        Path folder = root.resolve("a").resolve("b");

        JournalFolders.create(folder, synced::add);

        assertThat(folder).isDirectory();
        assertThat(synced).startsWith(root.resolve("a"), root, root.getParent());
    }

    private List<Journal> adopted(String owner) {
        List<Journal> adopted = new ArrayList<>();
        folders(owner).adopt(adopted::add);
        return adopted;
    }

    private JournalFolders folders(String owner) {
        return new JournalFolders(root, owner, SMALL);
    }
}
