package io.furrow.launcher.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.launcher.Furrow;
import io.furrow.model.device.FarmSecret;

import static org.assertj.core.api.Assertions.assertThat;

class InitCommandTest {
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();
    private final CommandLine furrow =
            Furrow.commandLine().setOut(new PrintWriter(out)).setErr(new PrintWriter(err));

    @Test
    void makesSecretsInAFolderThatOnlyItsOwnerMayEnter(@TempDir Path directory) throws Exception {
        Path folder = directory.resolve("secrets");

        assertThat(furrow.execute("init", folder.toString())).as(err.toString()).isZero();

        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(folder)))
                .isEqualTo("rwx------");
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(folder.resolve("mqtt/password"))))
                .as("users of containers")
                .isEqualTo("rw-r--r--");
        assertThat(folder.resolve("api/tokens")).content().matches("admin \\p{XDigit}{48} admin\n");
        assertThat(folder.resolve("mqtt/password")).content().matches("\\p{XDigit}{48}\n");
        String password = Files.readString(folder.resolve("mongo/password"));
        assertThat(password).matches("\\p{XDigit}{48}\n");
        assertThat(folder.resolve("mongo/uri"))
                .hasContent("mongodb://furrow:%s@mongo:27017/?authSource=admin".formatted(password.strip()));
        assertThat(password).isNotEqualTo(Files.readString(folder.resolve("mqtt/password")));
        assertThat(FarmSecret.read(folder.resolve("farm/secret")).newestKey()).isEqualTo(1);
    }

    @Test
    void leavesAFolderThatIsThereAsItIs(@TempDir Path folder) {
        assertThat(furrow.execute("init", folder.toString())).isNotZero();

        assertThat(folder).isEmptyDirectory();
        assertThat(err.toString()).contains(folder + " is there already").hasLineCount(1);
    }
}
