package io.furrow.bench.analytics.load;

import java.io.IOException;
import java.util.List;
import java.util.concurrent.TimeUnit;

import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Param;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.Warmup;

import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.FieldVersions;

/** The point in polygon: which of the fields a position is in. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 5, time = 1)
@Measurement(iterations = 5, time = 1)
public class FieldBenchmark {
    private static final int CORNERS = 50;

    @Param({"1", "1000"})
    private int fields;

    private SyntheticFields madeUp;
    private FieldVersions known;
    private long next;

    @Setup
    public void read() throws IOException {
        madeUp = new SyntheticFields(fields, CORNERS);
        known = FieldVersions.read(madeUp);
    }

    @Benchmark
    public List<Field> covering() {
        return known.covering(madeUp.position(next++), 1);
    }
}
