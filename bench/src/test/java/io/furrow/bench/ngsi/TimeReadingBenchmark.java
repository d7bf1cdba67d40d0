package io.furrow.bench.ngsi;

import java.time.Instant;
import java.time.OffsetDateTime;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.TextNode;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.Warmup;

import io.furrow.model.time.Instants;

/** A date and time as context brokers write it, read digit by digit and by the JDK. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 5, time = 1)
@Measurement(iterations = 5, time = 1)
public class TimeReadingBenchmark {
    private final TextNode time = TextNode.valueOf("2026-11-21T01:00:00.123Z");

    @Benchmark
    public Optional<Instant> digitByDigit() {
        return Instants.of(time);
    }

    @Benchmark
    public Instant byInstant() {
        return Instant.parse(time.textValue());
    }

    @Benchmark
    public Instant byOffsetDateTime() {
        return OffsetDateTime.parse(time.textValue()).toInstant();
    }
}
