package io.furrow.launcher;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class CommandLineTest {
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();
    private final CommandLine furrow =
            Furrow.commandLine().setOut(new PrintWriter(out)).setErr(new PrintWriter(err));

    @TempDir
    Path directory;

    @ParameterizedTest
    @CsvSource({
        "--help, demo",
        "demo --help, --kafka-port",
        "up --help, --orion",
        "bench --help, load",
        "bench load --help, --devices",
        "bench notifications --help, --new-connections",
        "bench sink --help, --stand-in",
        "bench control --help, --outstanding",
        "dead-letters refeed --help, --dry-run",
        "control-plane --help, --standby-replicas",
        "scenario --help, --qos",
        "device-host --help, --farm-secret",
        "domain create --help, --area",
        "mission --help, watch",
        "mission start --help, --duration",
        "mission export --help, --mongo",
        "template import --help, FILE",
        "device list --help, --mission",
        "alarm mute --help, --for",
        "replay start --help, --speed"
    })
    void explainsItself(String words, String mentioned) {
        assertThat(furrow.execute(words.split(" "))).isZero();
        assertThat(out.toString()).contains(mentioned);
    }

    @Test
    void namesThePortInUseAndTheOptionThatChoosesAnother() throws Exception {
        try (ServerSocket taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            String port = Integer.toString(taken.getLocalPort());

            assertThat(furrow.execute("up", "--kafka-port", "0", "--connect-port", "0", "--flink-port", port))
                    .isNotZero();

            assertThat(err.toString().trim())
                    .isEqualTo("Port " + port
                            + " of 127.0.0.1, meant for Flink's web UI, is in use. Stop what listens there, "
                            + "or choose another with --flink-port.");
        }
    }

    @Test
    void saysThatADirectoryCannotBeWritten() throws Exception {
        Path file = Files.createFile(directory.resolve("file"));

        assertThat(furrow.execute(upOnFreePorts(file.resolve("below")))).isNotZero();

        assertThat(err.toString().trim())
                .startsWith("Cannot write in " + file.resolve("below"))
                .endsWith("Name a directory that you may write with --data.")
                .hasLineCount(1);
    }

    @Test
    void refusesASecondSuiteInTheSameDirectory() {
        try (RunDirectory held = RunDirectory.open(directory)) {
            assertThat(furrow.execute(upOnFreePorts(held.path()))).isNotZero();
        }
        assertThat(err.toString()).contains("Another Furrow uses " + directory);
    }

    @Test
    void refusesAnUnknownOptionInOneSentence() {
        assertThat(furrow.execute("demo", "--orin", "x")).isNotZero();
        assertThat(err.toString()).contains("Unknown options: '--orin', 'x'").contains("furrow demo --help");
    }

    private static String[] upOnFreePorts(Path data) {
        return ("up --kafka-port 0 --connect-port 0 --flink-port 0 --notify-port 0 --mqtt-port 0 --orion-port 0 "
                        + "--iot-agent-port 0 --mongo-port 0 --data " + data)
                .split(" ");
    }
}
