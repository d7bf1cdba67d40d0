package io.furrow.soak.control;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

/** A JVM with this one's class path that can be killed and started again; its output is appended to one file. */
public final class JavaProcess implements AutoCloseable {
    private static final long STOP_SECONDS = 40;

    private final List<String> command = new ArrayList<>();
    private final Path output;
    private final Map<String, String> environment = new HashMap<>();
    private Process process;

    /** @param words options of the JVM, class and arguments */
    public JavaProcess(Path output, List<String> options, String mainClass, List<String> arguments) {
        this.output = output;
        command.add(Path.of(System.getProperty("java.home"), "bin", "java").toString());
        command.addAll(options);
        command.addAll(List.of("-cp", System.getProperty("java.class.path"), mainClass));
        command.addAll(arguments);
    }

    /** Lets none of this process's outlive it. */
    public static void endAllWithThisOne() {
        Runnable end = () -> ProcessHandle.current().descendants().forEach(ProcessHandle::destroyForcibly);
        Runtime.getRuntime().addShutdownHook(new Thread(end, "stop"));
    }

    /** Further variables of its environment. */
    public JavaProcess with(Map<String, String> variables) {
        environment.putAll(variables);
        return this;
    }

    public void start() throws IOException {
        Files.createDirectories(output.toAbsolutePath().getParent());
        ProcessBuilder builder = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.appendTo(output.toFile()));
        builder.environment().putAll(environment);
        process = builder.start();
    }

    public boolean isAlive() {
        return process != null && process.isAlive();
    }

    public long pid() {
        return process.pid();
    }

    /** Ends it as {@code kill -9} does. */
    public void kill() throws InterruptedException {
        process.destroyForcibly().waitFor();
    }

    /** Asks it to stop, and kills it where it does not. @return whether it stopped by itself in time */
    public boolean stop() throws InterruptedException {
        if (process == null) {
            return true;
        }
        process.destroy();
        boolean stopped = process.waitFor(STOP_SECONDS, TimeUnit.SECONDS);
        process.destroyForcibly().waitFor();
        return stopped;
    }

    @Override
    public void close() {
        if (process != null) {
            process.destroyForcibly();
        }
    }
}
