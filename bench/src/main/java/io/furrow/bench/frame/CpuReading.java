package io.furrow.bench.frame;

import java.lang.management.ManagementFactory;

import com.sun.management.OperatingSystemMXBean;

/**
 * The clock and the processor time of this JVM at one instant.
 *
 * @param nanos of {@link System#nanoTime}
 */
public record CpuReading(long nanos, long cpuNanos) {
    private static final OperatingSystemMXBean SYSTEM =
            (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();

    public static CpuReading now() {
        return new CpuReading(System.nanoTime(), SYSTEM.getProcessCpuTime());
    }

    /** Seconds since an earlier reading. */
    public double seconds(CpuReading from) {
        return (nanos - from.nanos) / 1e9;
    }

    /** Seconds of processor time since an earlier reading. */
    public double cpuSeconds(CpuReading from) {
        return (cpuNanos - from.cpuNanos) / 1e9;
    }
}
