package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.attribute.FileTime;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ReloadedFileTest {
    @TempDir
    Path folder;

    private final List<String> warnings = new ArrayList<>();
    private Path file;
    private int reads;
    private boolean unavailable;

    @BeforeEach
    void write() throws IOException {
        file = Files.writeString(folder.resolve("file"), "one");
    }

    @Test
    void readsAFileAgainOnlyAfterAChange() throws IOException {
        ReloadedFile<String> reloaded = open();
        assertThat(reloaded.get()).isEqualTo("one");
        assertThat(reloaded.get()).isEqualTo("one");
        assertThat(reads).isEqualTo(1);

        Files.writeString(file, "three");

        assertThat(reloaded.get()).isEqualTo("three");
    }

    /** Editors and Kubernetes replace a file by another one of the same size and time. */
    @Test
    void detectsAReplacedFile() throws IOException {
        FileTime time = Files.getLastModifiedTime(file);
        Path link = Files.createSymbolicLink(folder.resolve("link"), file);
        ReloadedFile<String> reloaded =
                ReloadedFile.open(List.of(link), () -> Files.readString(link), warnings::add, Duration.ZERO);
        Path other = Files.writeString(folder.resolve("other"), "two");
        Files.setLastModifiedTime(other, time);

        Files.createSymbolicLink(folder.resolve("next"), other);
        Files.move(folder.resolve("next"), link, StandardCopyOption.ATOMIC_MOVE);

        assertThat(reloaded.get()).isEqualTo("two");
    }

    @Test
    void keepsTheLastValidContentWarnsOnceAndRecovers() throws IOException {
        ReloadedFile<String> reloaded = open();
        Files.writeString(file, "bad");

        assertThat(reloaded.get()).isEqualTo("one");
        assertThat(reloaded.get()).isEqualTo("one");
        assertThat(warnings).containsExactly(file + " is bad; the content from before stays in use");
        assertThat(reloaded.problem()).contains(file + " is bad");

        Files.delete(file);
        assertThat(reloaded.get()).isEqualTo("one");
        assertThat(reloaded.problem()).contains("there is no file " + file);

        Files.writeString(file, "two");
        assertThat(reloaded.get()).isEqualTo("two");
        assertThat(reloaded.problem()).isEmpty();
        assertThat(warnings).hasSize(2);
    }

    /** A source may need more than the file, which may be unavailable when the file changes. */
    @Test
    void retriesWithoutAFurtherChangeOfTheFile() throws IOException {
        ReloadedFile<String> reloaded = open();
        Files.writeString(file, "two");
        unavailable = true;
        assertThat(reloaded.get()).isEqualTo("one");

        unavailable = false;

        assertThat(reloaded.get()).isEqualTo("two");
    }

    @Test
    void doesNotOpenAnInvalidFile() throws IOException {
        Files.writeString(file, "bad");

        assertThatThrownBy(this::open).isInstanceOf(IOException.class).hasMessage(file + " is bad");
    }

    private ReloadedFile<String> open() throws IOException {
        return ReloadedFile.open(List.of(file), this::read, warnings::add, Duration.ZERO);
    }

    private String read() throws IOException {
        reads++;
        String text = Files.readString(file);
        if (unavailable || text.equals("bad")) {
            throw new IOException(file + " is bad");
        }
        return text;
    }
}
