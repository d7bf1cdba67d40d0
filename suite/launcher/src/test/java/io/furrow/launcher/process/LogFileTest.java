package io.furrow.launcher.process;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.launcher.Furrow;
import io.furrow.process.TestProcess;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class LogFileTest {
    private static final Logger LOG = LoggerFactory.getLogger(LogFileTest.class);
    private static final int LINES = 200;
    private static final int TIMEOUT_MS = 60_000;

    @AfterEach
    void leaveTheFile() {
        System.clearProperty("furrow.log.size");
        LogFile.writeTo(Path.of("/dev/null"));
    }

    @Test
    void beginsAnewWhenItIsFullAndRetainsFiveFormerOnes(@TempDir Path directory) throws IOException {
        System.setProperty("furrow.log.size", "1KB");
        Path log = directory.resolve("furrow.log");

        LogFile.writeTo(log);
        writeLines();

        assertThat(directory.toFile().list())
                .containsExactlyInAnyOrder(
                        "furrow.log", "furrow.log.1", "furrow.log.2", "furrow.log.3", "furrow.log.4", "furrow.log.5");
        assertThat(Files.size(log)).isLessThan(2_000);
    }

    @Test
    void neverRenamesWhatIsNoFile(@TempDir Path directory) throws IOException {
        System.setProperty("furrow.log.size", "1KB");
        Path device = Files.createSymbolicLink(directory.resolve("device"), Path.of("/dev/null"));

        LogFile.writeTo(device);
        writeLines();

        assertThat(directory.toFile().list()).containsExactly("device");
        assertThat(device).isSymbolicLink();
    }

    @Test
    void isTheErrorStreamOfAServiceWhichIsASocket() throws Exception {
        assertThat(errorWith("the thermometer is silent", Service.class)).contains(" WARN ");
    }

    @Test
    void isTheErrorStreamOfAHostOfDevices(@TempDir Path directory) throws Exception {
        Path secret = Files.writeString(directory.resolve("secret"), "0123456789abcdef");
        Files.setPosixFilePermissions(secret, PosixFilePermissions.fromString("rw-r--r--"));

        assertThat(errorWith(
                        secret + " can be read by every user",
                        Furrow.class,
                        "device-host",
                        "--kafka",
                        "127.0.0.1:1",
                        "--farm-secret",
                        secret.toString()))
                .contains(" WARN ");
    }

    /** The line with a text that a program writes to its error stream, which is a socket, as systemd makes it; else what it wrote. */
    private static String errorWith(String text, Class<?> program, String... arguments) throws Exception {
        try (ServerSocket journal = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            journal.setSoTimeout(TIMEOUT_MS);
            List<String> command = new ArrayList<>(List.of(
                    "bash", "-c", "exec 2>/dev/tcp/127.0.0.1/%d \"$@\"".formatted(journal.getLocalPort()), "bash"));
            command.addAll(
                    TestProcess.java("-Xmx128m", program, (Object[]) arguments).command());
            Process process = new ProcessBuilder(command)
                    .redirectOutput(ProcessBuilder.Redirect.DISCARD)
                    .start();
            try (Socket errors = journal.accept();
                    BufferedReader lines = new BufferedReader(new InputStreamReader(errors.getInputStream(), UTF_8))) {
                errors.setSoTimeout(TIMEOUT_MS);
                StringBuilder others = new StringBuilder();
                String line = lines.readLine();
                while (line != null && !line.contains(text)) {
                    others.append(line).append('\n');
                    line = lines.readLine();
                }
                return line == null ? others.toString() : line;
            } finally {
                process.destroyForcibly().waitFor();
            }
        }
    }

    /** What a command does whose option {@code --log} is not given. */
    static final class Service {
        public static void main(String... arguments) {
            LogFile.writeTo(Path.of("/dev/stderr"));
            LOG.warn("the thermometer is silent");
        }
    }

    private static void writeLines() {
        for (int line = 0; line < LINES; line++) {
            LOG.info("line {} of {}", line, LINES);
        }
    }
}
