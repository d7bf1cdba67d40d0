package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class RunDirectoryTest {
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
    void retainsTheOneThatWasNamedAndLetsItBeUsedAgain(@TempDir Path parent) throws Exception {
        try (RunDirectory retained = RunDirectory.open(parent.resolve("kept"))) {
            Files.writeString(retained.resolve("file"), "x");
        }
        try (RunDirectory again = RunDirectory.open(parent.resolve("kept"))) {
            assertThat(again.resolve("file")).hasContent("x");
            assertThat(again.isTemporary()).isFalse();
        }
    }

    @Test
    void detectsWhetherASuiteHasStoredSomethingInIt(@TempDir Path parent) throws Exception {
        try (RunDirectory temporary = RunDirectory.open(null)) {
            assertThat(temporary.isFresh()).isTrue();
        }
        Path retained = parent.resolve("kept");
        RunDirectory.open(retained).close();
        Files.createFile(retained.resolve("furrow.log"));
        Files.createFile(retained.resolve("furrow.log.1"));
        try (RunDirectory refusedBefore = RunDirectory.open(retained)) {
            assertThat(refusedBefore.isFresh()).isTrue();
        }
        Files.createDirectory(retained.resolve("kafka"));
        try (RunDirectory used = RunDirectory.open(retained)) {
            assertThat(used.isFresh()).isFalse();
        }
    }

    @Test
    void letsNobodyElseReadADirectoryThatItMakes(@TempDir Path parent) throws Exception {
        Path retained = parent.resolve("var/kept");
        RunDirectory.open(retained).close();
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(retained)))
                .isEqualTo("rwx------");

        Files.setPosixFilePermissions(retained, PosixFilePermissions.fromString("rwxr-x---"));
        RunDirectory.open(retained).close();
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(retained)))
                .as("one that was there stays as it is")
                .isEqualTo("rwxr-x---");
    }
}
