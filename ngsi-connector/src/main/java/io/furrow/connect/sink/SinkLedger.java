package io.furrow.connect.sink;

import java.util.concurrent.atomic.LongAdder;

import io.furrow.connect.ledger.Metrics;

/**
 * Counts the records of a sink task since its start, each once, when its delivery is complete:
 *
 * <pre>
 * received = written + coalesced + stale + deleted + refused + unreadable + echo + ignored
 * </pre>
 */
final class SinkLedger extends Metrics {
    final LongAdder received = counter("received", "Records consumed from the topics, each counted once");
    final LongAdder written = counter("written", "Updates of entities that the context broker accepted");
    final LongAdder coalesced =
            counter("coalesced", "Records that were merged into the update of another, or overridden by a deletion");
    final LongAdder stale = counter("stale", "Records without a value newer than that of the context broker");
    final LongAdder deleted = counter("deleted", "Deletions done, including those of absent entities");
    final LongAdder refused = counter("refused", "Records that the context broker rejected");
    final LongAdder unreadable = counter("unreadable", "Records that cannot be read as an entity");
    final LongAdder echo = counter("echo", "Records that came from a context broker and were skipped");
    final LongAdder ignored = counter("ignored", "Tombstones skipped while deletions are disabled");
    final LongAdder retried = counter("retried", "Deliveries postponed because the context broker was unavailable");
}
