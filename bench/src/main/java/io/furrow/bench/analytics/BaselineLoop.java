package io.furrow.bench.analytics;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.UnaryOperator;

import org.HdrHistogram.Histogram;

import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.collision.grid.Tracker;
import io.furrow.analytics.collision.matching.Cell;
import io.furrow.analytics.collision.matching.PairSelection;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;

/**
 * A reference with the same grid and predicate in one thread and plain maps, for ordered positions: no serialization, state
 * backend, timers or distances of ongoing encounters. It is an upper limit for the speed of Flink's stages, and their results
 * must agree with it.
 */
final class BaselineLoop {
    private final Tracker tracker = new Tracker(CollisionRules.DEFAULT);
    private final PairSelection pairSelection = new PairSelection(CollisionRules.DEFAULT);
    private final Fleet fleet;
    private final UnaryOperator<PositionFix> received;
    private final Track[] tracks;
    private final Map<Long, Cell> cells = new HashMap<>();
    private final Map<Long, List<CellUpdate>> instant = new HashMap<>();
    private final Map<Pair, Integer> changes = new HashMap<>();
    private final Map<Pair, Boolean> close = new HashMap<>();
    private long now = Long.MIN_VALUE;
    private long starts;

    BaselineLoop(int devices) {
        this(devices, UnaryOperator.identity());
    }

    /** @param received rounds a position as a report does */
    BaselineLoop(int devices, UnaryOperator<PositionFix> received) {
        this.received = received;
        fleet = new Fleet(devices, 0, 1);
        tracks = new Track[devices];
    }

    /** The number of encounters that start in a second of event time, which must follow the previous one. */
    long second(long second) {
        starts = 0;
        for (long part = 0; part < Fleet.TICKS_PER_SECOND; part++) {
            fleet.tick(second * Fleet.TICKS_PER_SECOND + part, fix -> take(received.apply(fix)));
        }
        apply();
        return starts;
    }

    /** Nanoseconds per update, each alone at its instant, over some seconds of event time after as many of warm-up. */
    Histogram delays(int seconds) {
        Histogram delays = new Histogram(3);
        for (long tick = 0; tick < 2L * seconds * Fleet.TICKS_PER_SECOND; tick++) {
            if (tick == (long) seconds * Fleet.TICKS_PER_SECOND) {
                delays.reset();
            }
            fleet.tick(tick, fix -> {
                long begin = System.nanoTime();
                take(fix);
                apply();
                delays.recordValue(System.nanoTime() - begin);
            });
        }
        return delays;
    }

    void take(PositionFix fix) {
        if (fix.time() != now) {
            apply();
            now = fix.time();
        }
        int device = Fleet.number(fix);
        tracks[device] = tracker.move(
                tracks[device],
                fix,
                update -> instant.computeIfAbsent(update.cell(), cell -> new ArrayList<>(1))
                        .add(update));
    }

    /** The number of close pairs after all positions so far. */
    int close() {
        apply();
        return close.size();
    }

    private void apply() {
        instant.forEach((cell, updates) ->
                cells.computeIfAbsent(cell, id -> Cell.empty()).apply(updates, pairSelection, this::see));
        instant.clear();
        changes.forEach((pair, change) -> {
            if (change > 0) {
                starts++;
                close.put(pair, true);
            } else if (change < 0) {
                close.remove(pair);
            }
        });
        changes.clear();
    }

    private void see(PairObservation observation) {
        if (observation.change() != 0) {
            changes.merge(observation.pair(), observation.change(), Integer::sum);
        }
    }
}
