package io.furrow.bench.fleet;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;

import io.furrow.bench.frame.ProcessStatus;
import io.furrow.simulators.host.DeviceHostCommand;

/** A host of devices in its own JVM, to measure its memory and processor time. */
final class HostProcess implements AutoCloseable {
    /** Secret of the fictitious farm. */
    static final String SECRET = "bench bench bench bench";

    private final Process process;

    private HostProcess(Process process) {
        this.process = process;
    }

    /** @param folder of its files */
    static HostProcess start(int heapMb, String kafka, URI mqtt, Path folder) throws IOException {
        Path secret = Files.writeString(folder.resolve("secret"), SECRET);
        return new HostProcess(new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-Xmx" + heapMb + "m",
                        "-XX:+UseParallelGC",
                        "-Dfurrow.log=" + folder.resolve("fleet.log"),
                        "-cp",
                        System.getProperty("java.class.path"),
                        DeviceHostCommand.class.getName(),
                        "--kafka",
                        kafka,
                        "--mqtt",
                        mqtt.toString(),
                        "--farm-secret",
                        secret.toString())
                .redirectErrorStream(true)
                .redirectOutput(folder.resolve("host.log").toFile())
                .start());
    }

    /** Processor time so far. */
    Duration cpu() throws IOException {
        return process.info()
                .totalCpuDuration()
                .orElseThrow(() -> new IOException("the host of devices has ended; see host.log"));
    }

    /** Peak memory, in MB. */
    long peakMb() throws IOException {
        return ProcessStatus.of(process.pid(), "VmHWM") / 1024;
    }

    @Override
    public void close() {
        process.destroyForcibly();
    }
}
