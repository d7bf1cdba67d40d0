package io.furrow.launcher;

import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretFileTest {
    @TempDir
    Path directory;

    @Test
    void makesASecretOnceThatOnlyItsOwnerReads() throws Exception {
        Path file = directory.resolve("secret");

        String first = FarmSecretFile.readOrMake(file).apiKey("weeding");

        assertThat(FarmSecretFile.readOrMake(file).apiKey("weeding")).isEqualTo(first);
        assertThat(FarmSecretFile.readOrMake(directory.resolve("other")).apiKey("weeding"))
                .isNotEqualTo(first);
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(file)))
                .isEqualTo("rw-------");
    }

    @Test
    void refusesASecretThatIsTooShortAndOneThatCannotBeMade() throws Exception {
        Path tooShort = Files.writeString(directory.resolve("short"), "secret\n");

        assertThatThrownBy(() -> FarmSecretFile.readOrMake(tooShort))
                .isInstanceOf(SuiteNotStartedException.class)
                .hasMessageContainingAll(tooShort.toString(), "at least 16 bytes", "--farm-secret");
        assertThatThrownBy(() -> FarmSecretFile.readOrMake(directory.resolve("nosuch/secret")))
                .isInstanceOf(SuiteNotStartedException.class)
                .hasMessageContainingAll("nosuch", "--farm-secret");
    }
}
