package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Runs a program of the operating system. */
record Command(List<String> arguments, Process process, Path output) implements AutoCloseable {
    private static final long SECONDS = 120;

    /** Starts a program without waiting for it. @param arguments its name and arguments */
    static Command start(String... arguments) {
        return start(Map.of(), arguments);
    }

    /** Starts a program with additional environment variables. */
    static Command start(Map<String, String> variables, String... arguments) {
        try {
            Path output = Files.createTempFile("command", ".out");
            var builder =
                    new ProcessBuilder(arguments).redirectErrorStream(true).redirectOutput(output.toFile());
            builder.environment().putAll(variables);
            return new Command(List.of(arguments), builder.start(), output);
        } catch (IOException e) {
            throw new IllegalStateException(
                    arguments[0] + " is missing; install the Debian packages mosquitto-clients and curl", e);
        }
    }

    /** Runs a program to its end and returns its output. */
    static String run(String... arguments) throws IOException, InterruptedException {
        try (Command command = start(arguments)) {
            assertThat(command.exitCode())
                    .as("%s: %s", command.arguments, command.printed())
                    .isZero();
            return command.printed();
        }
    }

    int exitCode() throws InterruptedException {
        assertThat(process.waitFor(SECONDS, TimeUnit.SECONDS))
                .as("%s ends", arguments)
                .isTrue();
        return process.exitValue();
    }

    String printed() throws IOException {
        return Files.readString(output, UTF_8);
    }

    @Override
    public void close() throws IOException {
        process.destroy();
        Files.deleteIfExists(output);
    }
}
