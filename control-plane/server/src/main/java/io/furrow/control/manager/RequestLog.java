package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Optional;
import java.util.TreeMap;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.kstream.Windowed;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.StoreBuilder;
import org.apache.kafka.streams.state.Stores;
import org.apache.kafka.streams.state.WindowStore;
import org.apache.kafka.streams.state.WindowStoreIterator;

import io.furrow.model.control.Limits;

/**
 * Stores the ids of answered requests with their fingerprints; at most {@link Limits#REMEMBERED_REQUESTS}.
 *
 * <p><b>State</b>: fingerprint by request id, in a named window store of one manager. <b>Cleared</b>: by the store,
 * which drops whole windows after one to {@code 1 + 1/}{@value #WINDOWS} times the retention, by the clock of the
 * control plane, because a client's clock must not control deletions. That clock may be behind that of the instance that
 * stored the newest window: time then goes on from there, because the store would drop an older window at once.
 */
final class RequestLog {
    /** A lookup takes as many steps. */
    private static final int WINDOWS = 12;

    private final WindowStore<String, byte[]> store;
    private final long retention;
    private final TreeMap<Long, Integer> countByWindow = new TreeMap<>();
    /** Of the time of the windows to the clock, ms; 0 or positive. */
    private long offset;

    RequestLog(ProcessorContext<?, ?> context, String name, Duration retention) {
        this.store = context.getStateStore(name);
        this.retention = retention.toMillis();
        try (KeyValueIterator<Windowed<String>, byte[]> all = store.all()) {
            all.forEachRemaining(entry -> count(entry.key.window().start()));
        }
    }

    static StoreBuilder<WindowStore<String, byte[]>> builder(String name, Duration retention) {
        Duration window = Duration.ofMillis(window(retention.toMillis()));
        return Stores.windowStoreBuilder(
                Stores.inMemoryWindowStore(name, retention.plus(window), window, false),
                Serdes.String(),
                Serdes.ByteArray());
    }

    /** Returns the fingerprint of the answered request with an id; empty if there is none. */
    Optional<String> fingerprint(String requestId, long now) {
        try (WindowStoreIterator<byte[]> found =
                store.fetch(requestId, Math.max(0, time(now) - retention - window(retention)), Long.MAX_VALUE)) {
            return found.hasNext()
                    ? Optional.of(new String(found.next().value, StandardCharsets.UTF_8))
                    : Optional.empty();
        }
    }

    /** Whether no further id can be stored until the oldest window is dropped. */
    boolean isFull(long now) {
        countByWindow.headMap(time(now) - retention - 2 * window(retention)).clear();
        return countByWindow.values().stream().mapToInt(Integer::intValue).sum() >= Limits.REMEMBERED_REQUESTS;
    }

    void add(String requestId, String fingerprint, long now) {
        long time = time(now);
        long window = time - time % window(retention);
        store.put(requestId, fingerprint.getBytes(StandardCharsets.UTF_8), window);
        count(window);
    }

    private long time(long now) {
        if (!countByWindow.isEmpty()) {
            offset = Math.max(offset, countByWindow.lastKey() - now);
        }
        return now + offset;
    }

    private void count(long window) {
        countByWindow.merge(window, 1, Integer::sum);
    }

    private static long window(long retention) {
        return Math.max(1, retention / WINDOWS);
    }
}
