package io.furrow.bench.analytics.load;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
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
import org.openjdk.jmh.infra.Blackhole;

import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.collision.grid.Tracker;
import io.furrow.analytics.collision.matching.Cell;
import io.furrow.analytics.collision.matching.PairSelection;
import io.furrow.analytics.collision.rules.CollisionRules;

/** The search in a cell: one device moves, and those near it before and after are found. Of a fleet that fills 400 cells. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 5, time = 1)
@Measurement(iterations = 5, time = 1)
public class CellBenchmark {
    /** In each cell about a 400th of them. */
    @Param({"10000", "50000"})
    private int devices;

    private final PairSelection pairSelection = new PairSelection(CollisionRules.DEFAULT);
    private List<CellUpdate> updates;
    private Cell cell;
    private int next;

    /** The fullest cell, and what comes to it in some seconds. Its time starts again then, which it does not mind. */
    @Setup
    public void fill() {
        Tracker tracker = new Tracker(CollisionRules.DEFAULT);
        Map<Long, List<CellUpdate>> byCell = new HashMap<>();
        Track[] tracks = new Track[devices];
        Fleet fleet = new Fleet(devices, 0, 1);
        for (long tick = 0; tick < 4 * Fleet.TICKS_PER_SECOND; tick++) {
            fleet.tick(tick, fix -> {
                int device = Fleet.number(fix);
                tracks[device] = tracker.move(
                        tracks[device],
                        fix,
                        update -> byCell.computeIfAbsent(update.cell(), id -> new ArrayList<>())
                                .add(update));
            });
        }
        updates = byCell.values().stream()
                .max((one, other) -> Integer.compare(one.size(), other.size()))
                .orElseThrow();
        cell = Cell.empty();
        next = 0;
    }

    @Benchmark
    public void move(Blackhole out) {
        cell.apply(List.of(updates.get(next)), pairSelection, out::consume);
        next = next + 1 == updates.size() ? 0 : next + 1;
    }
}
