package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.Properties;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.cli.option.CommandException;
import io.furrow.model.device.FarmSecret;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretFileTest {
    @TempDir
    Path directory;

    @Test
    void makesASecretWhereADirectoryIsFreshAndFindsItThereLater() throws Exception {
        Path retained = directory.resolve("data");
        Path made;
        try (RunDirectory first = RunDirectory.open(retained)) {
            made = FarmSecretFile.of(first, null);
        }
        FarmSecret secret = FarmSecret.read(made);
        Files.createDirectory(retained.resolve("kafka"));

        try (RunDirectory second = RunDirectory.open(retained)) {
            assertThat(FarmSecretFile.of(second, null)).isEqualTo(made);
        }

        assertThat(FarmSecret.read(made)).isEqualTo(secret);
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(made)))
                .isEqualTo("rw-------");
    }

    @Test
    void makesNoSecretWhereThereIsDataOfAFarm() throws Exception {
        Path retained = Files.createDirectories(directory.resolve("data/kafka")).getParent();

        try (RunDirectory directory = RunDirectory.open(retained)) {
            assertThatThrownBy(() -> FarmSecretFile.of(directory, null))
                    .isInstanceOf(CommandException.class)
                    .hasMessageContainingAll(
                            retained + " has the data of a farm but not its secret",
                            "--farm-secret",
                            "./furrow secret new");
        }
        assertThat(retained.resolve("farm-secret")).doesNotExist();
    }

    @Test
    void makesNoSecretWhereThePathIsWrong() {
        Path missing = directory.resolve("not-mounted");

        try (RunDirectory fresh = RunDirectory.open(null)) {
            assertThatThrownBy(() -> FarmSecretFile.of(fresh, missing))
                    .isInstanceOf(CommandException.class)
                    .hasMessageContainingAll(missing.toString(), "./furrow secret new");
        }
        assertThatThrownBy(() -> FarmSecretFile.open(missing, new Properties(), null))
                .isInstanceOf(CommandException.class)
                .hasMessageContainingAll(missing.toString(), "./furrow secret new");
        assertThat(missing).doesNotExist();
    }

    @Test
    void rejectsASecretThatIsTooShort() throws Exception {
        Path tooShort = Files.writeString(directory.resolve("short"), "secret\n");

        assertThatThrownBy(() -> FarmSecretFile.open(tooShort, new Properties(), null))
                .isInstanceOf(CommandException.class)
                .hasMessageContainingAll(tooShort.toString(), "at least 16 bytes, this one 6");
    }
}
