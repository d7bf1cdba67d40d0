package io.furrow.control.manager;

import java.time.Duration;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.state.StoreBuilder;
import org.apache.kafka.streams.state.Stores;
import org.apache.kafka.streams.state.WindowStore;
import org.apache.kafka.streams.state.WindowStoreIterator;

/**
 * The ids of requests that were answered, with their answers.
 *
 * <p><b>State</b>: the answer by request id, in a named window store of one manager. <b>Cleared</b> by the store itself, which
 * drops whole windows, some time between one and {@code 1 + 1/}{@value #WINDOWS} times what was asked for, by the clock of the
 * control plane: that of a client must not decide what is forgotten.
 */
public final class AnsweredRequests {
    /** A look-up costs as many steps. */
    private static final int WINDOWS = 12;

    private final WindowStore<String, byte[]> store;
    private final long remembered;

    public AnsweredRequests(ProcessorContext<?, ?> context, String name, Duration remembered) {
        this.store = context.getStateStore(name);
        this.remembered = remembered.toMillis();
    }

    public static StoreBuilder<WindowStore<String, byte[]>> builder(String name, Duration remembered) {
        Duration window = Duration.ofMillis(window(remembered.toMillis()));
        return Stores.windowStoreBuilder(
                Stores.inMemoryWindowStore(name, remembered.plus(window), window, false),
                Serdes.String(),
                Serdes.ByteArray());
    }

    /** Null ids are never known. */
    boolean has(String requestId, long now) {
        if (requestId == null) {
            return false;
        }
        try (WindowStoreIterator<byte[]> found =
                store.fetch(requestId, Math.max(0, now - remembered - window(remembered)), Long.MAX_VALUE)) {
            return found.hasNext();
        }
    }

    /** Null ids are not remembered. */
    void add(String requestId, byte[] answer, long now) {
        if (requestId != null) {
            store.put(requestId, answer, now - now % window(remembered));
        }
    }

    private static long window(long remembered) {
        return Math.max(1, remembered / WINDOWS);
    }
}
