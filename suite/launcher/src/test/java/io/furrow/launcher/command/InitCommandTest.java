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
    void makesSecretsThatOnlyTheirOwnerMayRead(@TempDir Path directory) throws Exception {
        Path file = directory.resolve(".env");

        assertThat(furrow.execute("init", file.toString())).as(err.toString()).isZero();

        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(file)))
                .isEqualTo("rw-------");
        assertThat(Files.readString(file)).matches("""
                FARM_SECRET=[A-Za-z0-9+/]{43}=
                MONGO_PASSWORD=\\p{XDigit}{48}
                MQTT_PASSWORD=\\p{XDigit}{48}
                API_TOKENS="admin \\p{XDigit}{48} admin"
                """);
        assertThat(Files.readAllLines(file).stream().map(line -> line.replaceFirst("^\\w+=", "")))
                .doesNotHaveDuplicates();
    }

    @Test
    void makesASecretOfAFarm(@TempDir Path directory) throws Exception {
        furrow.execute("init", directory.resolve(".env").toString());
        String secret = Files.readAllLines(directory.resolve(".env")).get(0).replaceFirst("FARM_SECRET=", "");

        assertThat(FarmSecret.read(Files.writeString(directory.resolve("farm-secret"), secret))
                        .newestKey())
                .isEqualTo(1);
    }

    @Test
    void leavesAFileThatIsThereAsItIs(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve(".env"), "FARM_SECRET=of running containers\n");

        assertThat(furrow.execute("init", file.toString())).isNotZero();

        assertThat(file).hasContent("FARM_SECRET=of running containers\n");
        assertThat(err.toString()).contains(file + " is there already").hasLineCount(1);
    }
}
