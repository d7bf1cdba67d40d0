package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.TimeUnit;

import io.furrow.bench.command.BenchCommand;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

/** Runs a command of Furrow in a separate process with its own temporary directory. */
record FurrowProcess(Process process, Path output) implements AutoCloseable {
    static final Duration TIMEOUT = Duration.ofMinutes(3);

    /** @param temporary directory for temporary files of the process; its output is written beside it */
    static FurrowProcess start(Path temporary, String... arguments) throws IOException {
        String options = "-Xmx1g -XX:MaxDirectMemorySize=1g -Djava.io.tmpdir=%s -Dfurrow.plugins=%s"
                .formatted(temporary, System.getProperty("furrow.plugins"));
        Path output = temporary.resolveSibling(temporary.getFileName() + ".out");
        Process process = TestProcess.java(options, BenchCommand.class, (Object[]) arguments)
                .redirectErrorStream(true)
                .redirectOutput(output.toFile())
                .start();
        return new FurrowProcess(process, output);
    }

    String printed() throws IOException {
        return Files.readString(output);
    }

    boolean isAlive() {
        return process.isAlive();
    }

    /** Sends a signal, for instance {@code TERM}, and waits for the process to end. */
    void end(String signal) throws IOException, InterruptedException {
        new ProcessBuilder("kill", "-" + signal, Long.toString(process.pid()))
                .start()
                .waitFor();
        assertThat(process.waitFor(TIMEOUT.toSeconds(), TimeUnit.SECONDS))
                .as("the process ends; it printed %s", printed())
                .isTrue();
    }

    @Override
    public void close() {
        process.destroyForcibly();
    }
}
