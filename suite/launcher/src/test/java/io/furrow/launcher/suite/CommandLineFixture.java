package io.furrow.launcher.suite;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.util.stream.Stream;

import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.launcher.Furrow;

import static org.assertj.core.api.Assertions.assertThat;

/** Runs command lines that end at once. */
abstract class CommandLineFixture {
    final StringWriter out = new StringWriter();
    final StringWriter err = new StringWriter();
    final CommandLine furrow = Furrow.commandLine().setOut(new PrintWriter(out)).setErr(new PrintWriter(err));

    @TempDir
    Path directory;

    /** What it says of a command line that it does not carry out. */
    String refusal(String... arguments) {
        err.getBuffer().setLength(0);
        assertThat(furrow.execute(arguments)).isNotZero();
        return err.toString();
    }

    static String[] with(String[] some, String... more) {
        return Stream.of(some, more).flatMap(Stream::of).toArray(String[]::new);
    }

    String[] upOnPorts(String flink, String mqtt) {
        return String.join(" ", upOnFreePorts(directory))
                .replace("--flink-port 0", "--flink-port " + flink)
                .replace("--mqtt-port 0", "--mqtt-port " + mqtt)
                .split(" ");
    }

    static String[] upOnFreePorts(Path data) {
        return ("up --kafka-port 0 --connect-port 0 --flink-port 0 --notify-port 0 --mqtt-port 0 --orion-port 0 "
                        + "--iot-agent-port 0 --mongo-port 0 --control-port 0 --health-port 0 --data " + data)
                .split(" ");
    }
}
