package io.furrow.soak.control;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

/** A JVM with the class path of this one, which can be killed and started again; appends its output to one file. */
public final class JavaProcess implements AutoCloseable {
    private static final long STOP_SECONDS = 40;

    private final List<String> command = new ArrayList<>();
    private final Path output;
    private final Map<String, String> environment = new HashMap<>();
    private Process process;

    /** @param options of the JVM */
    public JavaProcess(Path output, List<String> options, String mainClass, List<String> arguments) {
        this.output = output;
        command.add(Path.of(System.getProperty("java.home"), "bin", "java").toString());
        command.addAll(options);
        command.addAll(List.of("-cp", System.getProperty("java.class.path"), mainClass));
        command.addAll(arguments);
    }

    /** Kills all child processes when this process ends. */
    public static void killChildrenAtExit() {
        Runnable kill = () -> ProcessHandle.current().descendants().forEach(ProcessHandle::destroyForcibly);
        Runtime.getRuntime().addShutdownHook(new Thread(kill, "stop"));
    }

    /** Adds environment variables. */
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

    /** Kills the process like {@code kill -9}. */
    public void kill() throws InterruptedException {
        process.destroyForcibly().waitFor();
    }

    /** Stops the process, and kills it at a timeout. @return whether it stopped in time */
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
