package io.furrow.launcher;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import static org.assertj.core.api.Assertions.assertThat;

class LogFileTest {
    private static final Logger LOG = LoggerFactory.getLogger(LogFileTest.class);
    private static final int LINES = 200;

    @TempDir
    Path directory;

    @AfterEach
    void leaveTheFile() {
        System.clearProperty("furrow.log.size");
        LogFile.writeTo(Path.of("/dev/null"));
    }

    @Test
    void beginsAnewWhenItIsFullAndRetainsFiveFormerOnes() throws IOException {
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
    void neverRenamesWhatIsNoFile() throws IOException {
        System.setProperty("furrow.log.size", "1KB");
        Path device = Files.createSymbolicLink(directory.resolve("device"), Path.of("/dev/null"));

        LogFile.writeTo(device);
        writeLines();

        assertThat(directory.toFile().list()).containsExactly("device");
        assertThat(device).isSymbolicLink();
    }

    private static void writeLines() {
        for (int line = 0; line < LINES; line++) {
            LOG.info("line {} of {}", line, LINES);
        }
    }
}
