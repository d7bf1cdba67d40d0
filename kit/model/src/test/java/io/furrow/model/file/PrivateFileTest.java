package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class PrivateFileTest {
    @Test
    void createsAFileForItsOwnerAndNeverOverwrites(@TempDir Path folder) throws IOException {
        Path file = folder.resolve("file");

        PrivateFile.create(file, "one");

        assertThat(permissions(file)).isEqualTo("rw-------");
        assertThatThrownBy(() -> PrivateFile.create(file, "two")).isInstanceOf(FileAlreadyExistsException.class);
        assertThat(file).hasContent("one");
    }

    @Test
    void replacesAFileBehindALinkAndKeepsItsPermissions(@TempDir Path folder) throws IOException {
        Path file = Files.writeString(folder.resolve("file"), "one");
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rw-r-----"));
        Path link = Files.createSymbolicLink(folder.resolve("link"), file);

        PrivateFile.replace(link, "two");

        assertThat(file).hasContent("two");
        assertThat(Files.isSymbolicLink(link)).isTrue();
        assertThat(permissions(file)).isEqualTo("rw-r-----");
        assertThat(folder).isDirectoryNotContaining(each -> each.toString().endsWith(".new"));
    }

    @Test
    void warnsOfAFileThatOthersMayRead(@TempDir Path folder) throws IOException {
        Path file = Files.writeString(folder.resolve("file"), "one");
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rw-r-----"));
        assertThat(PrivateFile.exposure(file)).isEmpty();

        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rw-r--r--"));

        assertThat(PrivateFile.exposure(file))
                .hasValueSatisfying(sentence ->
                        assertThat(sentence).contains("every user of this machine", "rw-r--r--", "chmod o= " + file));
    }

    private static String permissions(Path file) throws IOException {
        return PosixFilePermissions.toString(Files.getPosixFilePermissions(file));
    }
}
