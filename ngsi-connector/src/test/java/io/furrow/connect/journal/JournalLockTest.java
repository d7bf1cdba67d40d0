package io.furrow.connect.journal;

import java.nio.file.Path;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

class JournalLockTest {
    private static final JournalSettings SMALL = new JournalSettings(64 * 1024, 4 * 1024, 8 * 1024, 0);

    @TempDir
    private Path folder;

    /** To close a file drops the process's lock on it, so that a failed try here could let another process in. */
    @Tag("full")
    @Test
    void isOpenInOneProcessOnlyAlsoAfterAnotherTryInThisOne() throws Exception {
        try (Journal journal = Journal.open(folder, SMALL).orElseThrow()) {
            assertThat(Journal.open(folder, SMALL)).isEmpty();
            assertThat(anotherProcess()).isEqualTo("opened false");
            assertThat(journal.end()).isZero();
        }
        assertThat(anotherProcess()).isEqualTo("opened true");
    }

    private String anotherProcess() throws Exception {
        String output = TestProcess.run(TestProcess.java("-Xmx64m", JournalOpener.class, folder))
                .output();
        return output.strip().lines().reduce((first, second) -> second).orElseThrow();
    }
}
