package io.furrow.bench.analytics.load;

import java.util.SplittableRandom;
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

import io.furrow.analytics.collision.matching.CellEntry;
import io.furrow.analytics.collision.matching.Proximity;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/** The predicate: whether two devices are close, for pairs at some distance. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 5, time = 1)
@Measurement(iterations = 5, time = 1)
public class ProximityBenchmark {
    private static final int PAIRS = 1024;
    private static final double METER = 360 / (2 * Math.PI * 6_371_000);

    /** Meters; at the threshold itself haversine decides. */
    @Param({"1", "5", "50"})
    private double distance;

    private final Proximity proximity = new Proximity(CollisionRules.DEFAULT);
    private final CellEntry[] ones = new CellEntry[PAIRS];
    private final CellEntry[] others = new CellEntry[PAIRS];
    private int next;

    @Setup
    public void place() {
        SplittableRandom random = new SplittableRandom(7);
        for (int i = 0; i < PAIRS; i++) {
            double latitude = random.nextDouble(40, 41);
            double longitude = random.nextDouble(-4, -3);
            ones[i] = CellEntry.of(fix("a" + i, latitude, longitude), true);
            others[i] = CellEntry.of(fix("b" + i, latitude + distance * METER, longitude), true);
        }
    }

    private static PositionFix fix(String id, double latitude, double longitude) {
        return Fleet.fix("farm|/|" + id, id, latitude, longitude, 0);
    }

    @Benchmark
    public boolean holds() {
        next = next + 1 & PAIRS - 1;
        return proximity.holds(ones[next], others[next]);
    }
}
