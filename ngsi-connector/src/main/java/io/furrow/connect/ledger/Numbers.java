package io.furrow.connect.ledger;

import java.util.List;

/** What a task of either connector counts, and what it has now. */
public interface Numbers {
    /** In a fixed order. */
    List<Counter> counters();

    /** In a fixed order. */
    List<Gauge> gauges();
}
