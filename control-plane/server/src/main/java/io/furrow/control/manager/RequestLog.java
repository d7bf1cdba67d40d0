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
 * The ids of requests that were answered, each with the fingerprint of its request; at most {@link Limits#REMEMBERED_REQUESTS}.
 *
 * <p><b>State</b>: the fingerprint by request id, in a named window store of one manager. <b>Cleared</b> by the store itself, which
 * drops whole windows, some time between one and {@code 1 + 1/}{@value #WINDOWS} times what was asked for, by the clock of the
 * control plane: that of a client must not decide what is forgotten.
 */
final class RequestLog {
    /** A look-up costs as many steps. */
    private static final int WINDOWS = 12;

    private final WindowStore<String, byte[]> store;
    private final long remembered;
    private final TreeMap<Long, Integer> countByWindow = new TreeMap<>();

    RequestLog(ProcessorContext<?, ?> context, String name, Duration remembered) {
        this.store = context.getStateStore(name);
        this.remembered = remembered.toMillis();
        try (KeyValueIterator<Windowed<String>, byte[]> all = store.all()) {
            all.forEachRemaining(entry -> count(entry.key.window().start()));
        }
    }

    static StoreBuilder<WindowStore<String, byte[]>> builder(String name, Duration remembered) {
        Duration window = Duration.ofMillis(window(remembered.toMillis()));
        return Stores.windowStoreBuilder(
                Stores.inMemoryWindowStore(name, remembered.plus(window), window, false),
                Serdes.String(),
                Serdes.ByteArray());
    }

    /** The fingerprint of the request that was answered under an id; empty if none was. */
    Optional<String> fingerprint(String requestId, long now) {
        try (WindowStoreIterator<byte[]> found =
                store.fetch(requestId, Math.max(0, now - remembered - window(remembered)), Long.MAX_VALUE)) {
            return found.hasNext()
                    ? Optional.of(new String(found.next().value, StandardCharsets.UTF_8))
                    : Optional.empty();
        }
    }

    /** Whether there is room for no further id until the oldest window is forgotten. */
    boolean isFull(long now) {
        countByWindow.headMap(now - remembered - 2 * window(remembered)).clear();
        return countByWindow.values().stream().mapToInt(Integer::intValue).sum() >= Limits.REMEMBERED_REQUESTS;
    }

    void add(String requestId, String fingerprint, long now) {
        long window = now - now % window(remembered);
        store.put(requestId, fingerprint.getBytes(StandardCharsets.UTF_8), window);
        count(window);
    }

    private void count(long window) {
        countByWindow.merge(window, 1, Integer::sum);
    }

    private static long window(long remembered) {
        return Math.max(1, remembered / WINDOWS);
    }
}
