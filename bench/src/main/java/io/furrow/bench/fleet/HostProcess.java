package io.furrow.bench.fleet;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;

import io.furrow.simulators.host.DeviceHostCommand;

/** A host of devices in a JVM of its own, so that its memory and processor time are its own. */
final class HostProcess implements AutoCloseable {
    private final Process process;

    private HostProcess(Process process) {
        this.process = process;
    }

    static HostProcess start(FleetPlan plan, FleetPlan.Ends ends) throws IOException {
        Path secret = Files.writeString(ends.folder().resolve("secret"), FleetPlan.SECRET);
        return new HostProcess(new ProcessBuilder(
                        Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-Xmx" + plan.heapMb() + "m",
                        "-XX:+UseParallelGC",
                        "-Dfurrow.log=" + ends.folder().resolve("fleet.log"),
                        "-cp",
                        System.getProperty("java.class.path"),
                        DeviceHostCommand.class.getName(),
                        "--kafka",
                        ends.kafka(),
                        "--mqtt",
                        ends.mqtt().toString(),
                        "--farm-secret",
                        secret.toString())
                .redirectErrorStream(true)
                .redirectOutput(ends.folder().resolve("host.log").toFile())
                .start());
    }

    /** Processor time by now. */
    Duration cpu() throws IOException {
        return process.info()
                .totalCpuDuration()
                .orElseThrow(() -> new IOException("the host of devices has ended; see host.log"));
    }

    /** The most memory that it has had, in MB; 0 where the system does not say. */
    long peakMb() throws IOException {
        Path status = Path.of("/proc", Long.toString(process.pid()), "status");
        if (!Files.exists(status)) {
            return 0;
        }
        return Files.readAllLines(status).stream()
                .filter(line -> line.startsWith("VmHWM:"))
                .mapToLong(line -> Long.parseLong(line.replaceAll("\\D", "")) / 1024)
                .findFirst()
                .orElse(0);
    }

    @Override
    public void close() {
        process.destroyForcibly();
    }
}
