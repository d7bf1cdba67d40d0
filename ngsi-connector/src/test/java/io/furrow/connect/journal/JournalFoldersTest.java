package io.furrow.connect.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

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
            JournalTest.append(journal, "kept");
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
            JournalTest.append(journal, "left");
        }
        folders("other").take(0).close();
        try (Journal own = folders("farm").take(0)) {
            List<Journal> adopted = folders("farm").adopt();
            assertThat(adopted).extracting(Journal::id).containsExactly(left);
            assertThat(folders("farm").adopt()).isEmpty();
            assertThat(own.id()).isNotEqualTo(left);
            adopted.get(0).delete();
            assertThat(root.resolve("farm").resolve(left)).doesNotExist();
        }
    }

    @Test
    void leavesFoldersAloneThatAreNoJournals() throws Exception {
        Path other = Files.createDirectories(root.resolve("farm").resolve("notes"));

        assertThat(folders("farm").adopt()).isEmpty();
        assertThat(other).isEmptyDirectory();
    }

    @Test
    void listsWhatNobodyHasOpenAndHoldsSomething() throws Exception {
        try (Journal open = folders("farm").take(0)) {
            JournalTest.append(open, "in use");
            try (Journal gone = folders("gone farm/1").take(0)) {
                JournalTest.append(gone, "left");
            }
            folders("empty").take(0).close();

            assertThat(folders("farm").orphans()).singleElement().satisfies(orphan -> {
                assertThat(orphan.owner()).isEqualTo("gone%20farm%2F1");
                assertThat(orphan.bytes()).isPositive();
            });
        }
        assertThat(folders("farm").orphans()).hasSize(2);
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

    private JournalFolders folders(String owner) {
        return new JournalFolders(root, owner, SMALL);
    }
}
