package io.furrow.process;

import java.io.IOException;
import java.lang.management.ManagementFactory;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

import static org.assertj.core.api.Assertions.assertThat;

/** Runs programs of the JDK of the tests in separate processes. */
public final class TestProcess {
    /** Exit status and output of a program. */
    public record Ended(int status, String output) {}

    private TestProcess() {}

    /**
     * A JVM with the class path and the {@code --add-…} options of this one.
     *
     * @param options of the JVM, separated by spaces
     */
    public static ProcessBuilder java(String options, Class<?> main, Object... arguments) {
        List<String> command = new ArrayList<>(List.of(program("java")));
        ManagementFactory.getRuntimeMXBean().getInputArguments().stream()
                .filter(argument -> argument.startsWith("--add-"))
                .forEach(command::add);
        command.addAll(List.of(options.split(" ")));
        command.addAll(List.of("-cp", System.getProperty("java.class.path"), main.getName()));
        Stream.of(arguments).map(Object::toString).forEach(command::add);
        return new ProcessBuilder(command);
    }

    /** @param words arguments separated by spaces */
    public static void keytool(String words) throws IOException, InterruptedException {
        List<String> command = new ArrayList<>(List.of(program("keytool")));
        command.addAll(List.of(words.split("\\s+")));
        Ended ended = run(new ProcessBuilder(command));
        assertThat(ended.status()).as(ended.output()).isZero();
    }

    /** Runs a program until it ends, with a timeout of two minutes. */
    public static Ended run(ProcessBuilder builder) throws IOException, InterruptedException {
        Path output = Files.createTempFile("process", ".out");
        Process process = builder.redirectErrorStream(true)
                .redirectOutput(output.toFile())
                .start();
        try {
            assertThat(process.waitFor(2, TimeUnit.MINUTES))
                    .as("%s ends", builder.command())
                    .isTrue();
            return new Ended(process.exitValue(), Files.readString(output));
        } finally {
            process.destroyForcibly();
            Files.delete(output);
        }
    }

    /** A program of the JDK. */
    public static String program(String name) {
        return Path.of(System.getProperty("java.home"), "bin", name).toString();
    }
}
