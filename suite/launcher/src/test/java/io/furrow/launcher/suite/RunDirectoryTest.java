package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class RunDirectoryTest {
    @TempDir
    Path parent;

    @Test
    void deletesATemporaryOneWithAllThatIsInIt() throws Exception {
        Path path;
        try (RunDirectory temporary = RunDirectory.open(null)) {
            path = temporary.path();
            Files.writeString(Files.createDirectories(temporary.resolve("a/b")).resolve("file"), "x");
            assertThat(temporary.isTemporary()).isTrue();
        }
        assertThat(path).doesNotExist();
    }

    @Test
    void keepsTheOneThatWasNamedAndLetsItBeUsedAgain() throws Exception {
        try (RunDirectory kept = RunDirectory.open(parent.resolve("kept"))) {
            Files.writeString(kept.resolve("file"), "x");
        }
        try (RunDirectory again = RunDirectory.open(parent.resolve("kept"))) {
            assertThat(again.resolve("file")).hasContent("x");
            assertThat(again.isTemporary()).isFalse();
        }
    }

    @Test
    void knowsWhetherASuiteHasKeptSomethingInIt() throws Exception {
        try (RunDirectory temporary = RunDirectory.open(null)) {
            assertThat(temporary.isFresh()).isTrue();
        }
        Path kept = parent.resolve("kept");
        RunDirectory.open(kept).close();
        Files.createFile(kept.resolve("furrow.log"));
        Files.createFile(kept.resolve("furrow.log.1"));
        try (RunDirectory refusedBefore = RunDirectory.open(kept)) {
            assertThat(refusedBefore.isFresh()).isTrue();
        }
        Files.createDirectory(kept.resolve("kafka"));
        try (RunDirectory used = RunDirectory.open(kept)) {
            assertThat(used.isFresh()).isFalse();
        }
    }

    @Test
    void letsNobodyElseLookIntoADirectoryThatItMakes() throws Exception {
        Path kept = parent.resolve("var/kept");
        RunDirectory.open(kept).close();
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(kept)))
                .isEqualTo("rwx------");

        Files.setPosixFilePermissions(kept, PosixFilePermissions.fromString("rwxr-x---"));
        RunDirectory.open(kept).close();
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(kept)))
                .as("one that was there stays as it is")
                .isEqualTo("rwxr-x---");
    }
}
