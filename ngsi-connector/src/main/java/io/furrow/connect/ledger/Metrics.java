package io.furrow.connect.ledger;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.LongSupplier;

/** The counters and gauges of a task of either connector, in the order in which they were added. */
public class Metrics {
    private final List<Metric> metrics = new CopyOnWriteArrayList<>();

    /** Adds a counter that starts at 0; any thread may increment it. */
    protected final LongAdder counter(String name, String help) {
        LongAdder counter = new LongAdder();
        metrics.add(new Metric(name, help, true, counter::sum));
        return counter;
    }

    /** @param now called when the metrics are read: fast, thread-safe, and without exceptions */
    public final void gauge(String name, String help, LongSupplier now) {
        metrics.add(new Metric(name, help, false, now));
    }

    /** All counters and gauges. */
    public final List<Metric> all() {
        return List.copyOf(metrics);
    }
}
