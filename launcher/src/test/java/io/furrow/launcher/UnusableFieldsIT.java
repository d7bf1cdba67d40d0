package io.furrow.launcher;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class UnusableFieldsIT {
    @TempDir
    Path directory;

    @Test
    void stopsAgainAndSaysWhyFieldsCannotBeUsed() throws Exception {
        Path fields = Files.writeString(directory.resolve("fields.geojson"), "{}");
        StringWriter err = new StringWriter();
        String words = "up --kafka-port 0 --connect-port 0 --flink-port 0 --notify-port 0 --mqtt-port 0 --orion-port 0 "
                + "--iot-agent-port 0 --mongo-port 0 --fields " + fields;

        assertThat(Furrow.commandLine()
                        .setOut(new PrintWriter(new StringWriter()))
                        .setErr(new PrintWriter(err))
                        .execute(words.split(" ")))
                .isNotZero();

        assertThat(err.toString().trim()).startsWith("--fields " + fields).hasLineCount(1);
    }
}
