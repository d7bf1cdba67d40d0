package io.furrow.launcher;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class UnusableFieldsTest {
    /** Before it takes a port, or waits for an engine. */
    @Test
    void reportsWhyFieldsCannotBeUsedBeforeAnythingStarts(@TempDir Path directory) throws Exception {
        Path fields = Files.writeString(directory.resolve("fields.geojson"), "{}");
        StringWriter err = new StringWriter();
        try (ServerSocket taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            assertThat(Furrow.commandLine()
                            .setOut(new PrintWriter(new StringWriter()))
                            .setErr(new PrintWriter(err))
                            .execute(
                                    "up",
                                    "--kafka-port",
                                    Integer.toString(taken.getLocalPort()),
                                    "--fields",
                                    fields.toString()))
                    .isNotZero();
        }

        assertThat(err.toString().trim()).startsWith("--fields " + fields).hasLineCount(1);
    }
}
