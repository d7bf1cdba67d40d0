package io.furrow.bench.ingest;

import java.lang.management.ManagementFactory;
import java.util.ArrayList;
import java.util.List;

import com.sun.management.OperatingSystemMXBean;

/** Samples of the number of readable records, and of the processor time of this JVM. */
final class Throughput {
    private static final double FROM = 0.1;
    private static final double TO = 0.9;

    private static final OperatingSystemMXBean SYSTEM =
            (OperatingSystemMXBean) ManagementFactory.getOperatingSystemMXBean();

    private final long expected;
    private final List<Sample> samples = new ArrayList<>();

    /** @param expected final number of records */
    Throughput(long expected) {
        this.expected = expected;
    }

    private record Sample(long nanos, long processorNanos, long records) {}

    void add(long records) {
        add(System.nanoTime(), SYSTEM.getProcessCpuTime(), records);
    }

    void add(long nanos, long processorNanos, long records) {
        samples.add(new Sample(nanos, processorNanos, records));
    }

    boolean areAll() {
        return !samples.isEmpty() && samples.get(samples.size() - 1).records() >= expected;
    }

    /** The rates between two samples. */
    record Pace(double perSecond, double processorMicrosEach) {}

    /**
     * Between the samples at a tenth and at nine tenths of the records: without the start of the job, and without the wait
     * for the final checkpoint, which with exactly-once would favor the slower job.
     *
     * @throws IllegalStateException if both fall into one sample
     */
    Pace pace() {
        Sample from = firstWith(FROM);
        Sample to = firstWith(TO);
        if (from == to) {
            throw new IllegalStateException("all records came at once; measure more of them (--records)");
        }
        double records = to.records() - from.records();
        return new Pace(
                records * 1e9 / (to.nanos() - from.nanos()),
                (to.processorNanos() - from.processorNanos()) / 1e3 / records);
    }

    private Sample firstWith(double share) {
        return samples.stream()
                .filter(sample -> sample.records() >= share * expected)
                .findFirst()
                .orElseThrow();
    }
}
