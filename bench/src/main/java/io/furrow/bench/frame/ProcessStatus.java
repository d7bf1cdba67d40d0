package io.furrow.bench.frame;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** Reads the status of processes from Linux, and of this one from the JVM. */
public final class ProcessStatus {
    private ProcessStatus() {}

    /** A number from {@code /proc/PID/status}; memory in kB. @throws IOException if the process has ended */
    public static long of(long pid, String name) throws IOException {
        Path status = Path.of("/proc", Long.toString(pid), "status");
        return Files.readAllLines(status).stream()
                .filter(line -> line.startsWith(name + ":"))
                .mapToLong(line -> Long.parseLong(line.replaceAll("\\D", "")))
                .findFirst()
                .orElseThrow(() -> new IOException(status + " has no line " + name));
    }

    /** Bytes of this JVM's heap in use, after a collection. */
    public static long heapAfterCollection() {
        System.gc();
        return Runtime.getRuntime().totalMemory() - Runtime.getRuntime().freeMemory();
    }
}
