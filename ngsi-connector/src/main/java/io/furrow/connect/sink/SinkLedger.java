package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.List;

import io.furrow.connect.ledger.Counter;
import io.furrow.connect.ledger.Gauge;
import io.furrow.connect.ledger.Numbers;

/**
 * What one task has counted since its start, once per record, when the delivery that it is in is through:
 *
 * <pre>
 * received = written + coalesced + stale + deleted + refused + unreadable + echo + ignored
 * </pre>
 */
final class SinkLedger implements Numbers {
    private final List<Counter> counters = new ArrayList<>();

    final Counter received = counter("received", "Records taken from the topics, each counted once");
    final Counter written = counter("written", "Updates of entities that the context broker took");
    final Counter coalesced =
            counter("coalesced", "Records that are in the update of another, or gave way to a deletion");
    final Counter stale = counter("stale", "Records that say nothing newer than what the context broker has");
    final Counter deleted = counter("deleted", "Deletions done, of entities already absent included");
    final Counter refused = counter("refused", "Records that the context broker does not take");
    final Counter unreadable = counter("unreadable", "Records that are about no entity");
    final Counter echo = counter("echo", "Records that came from a context broker, and were left out");
    final Counter ignored = counter("ignored", "Records without value while deletions are switched off");
    final Counter retried = counter("retried", "Deliveries put off because the context broker is away");

    private Counter counter(String name, String help) {
        Counter counter = new Counter(name, help);
        counters.add(counter);
        return counter;
    }

    @Override
    public List<Counter> counters() {
        return List.copyOf(counters);
    }

    @Override
    public List<Gauge> gauges() {
        return List.of();
    }
}
