package io.furrow.bench.analytics;

import java.lang.management.ManagementFactory;
import java.lang.management.ThreadMXBean;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.stream.IntStream;

import io.furrow.analytics.collision.grid.CellPresence;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.matching.Cell;
import io.furrow.analytics.collision.matching.PairSelection;
import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.bench.analytics.load.CrowdedFleet;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.bench.frame.Figures;

/** Measures devices on one spot in the cell that they share, in processor time of one thread and without Flink. */
final class CrowdMeasurement {
    private static final ThreadMXBean THREADS = ManagementFactory.getThreadMXBean();
    private static final long CELL = 7;

    private final PairSelection pairSelection;
    private final Random random = new Random(1);
    private final Duration measured;
    private long observations;

    private CrowdMeasurement(CollisionRules rules, Duration measured) {
        pairSelection = new PairSelection(rules);
        this.measured = measured;
    }

    /**
     * Adds a row; each device reports once a second of event time, at its own millisecond.
     *
     * @param crowd the option of that name; 0 follows all pairs
     */
    static void run(int devices, int crowd, Duration measured, Figures figures) {
        CollisionRules rules = CollisionRules.DEFAULT;
        CellRules cells = new CellRules(rules.cellMeters(), crowd);
        new CrowdMeasurement(rules.with(cells), measured).measure(devices, crowd, figures);
    }

    private void measure(int devices, int crowd, Figures figures) {
        List<String> ids = IntStream.range(0, devices)
                .mapToObj("urn:ngsi-ld:Robot:%d"::formatted)
                .toList();
        Cell cell = Cell.empty();
        second(cell, ids, 0);
        second(cell, ids, 1); // the JVM was cold
        observations = 0;
        long used = 0;
        long second = 2;
        while (used < measured.toNanos()) {
            used += second(cell, ids, second++);
        }
        double updates = (second - 2) * (double) devices;
        figures.add(
                "devices", devices,
                "crowd", crowd,
                "cpu us", used / 1e3 / updates,
                "sightings", observations / updates,
                "us each", used / 1e3 / observations);
    }

    /** Processor time of the cell for a second of event time, in nanoseconds. */
    private long second(Cell cell, List<String> ids, long second) {
        List<CellUpdate> updates = new ArrayList<>();
        for (int device = 0; device < ids.size(); device++) {
            long time = Fleet.START + second * 1000 + device * 1000L / ids.size();
            updates.add(new CellUpdate(
                    CELL,
                    time,
                    CellPresence.RESIDENT,
                    CrowdedFleet.noisy(ids.get(device), Fleet.LATITUDE, time, random)));
        }
        updates.sort(CellUpdate.SEQUENCE);
        long begin = THREADS.getCurrentThreadCpuTime();
        cell.apply(updates, pairSelection, observation -> observations++);
        return THREADS.getCurrentThreadCpuTime() - begin;
    }
}
