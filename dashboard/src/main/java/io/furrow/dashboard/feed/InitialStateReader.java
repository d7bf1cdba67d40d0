package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.function.Function;

import io.furrow.kafka.DaemonThreads;

/**
 * Reads the initial states of topics on its own threads. Reads a topic once for all requests that arrived before the
 * read began. Topics do not wait for each other, unless more are read than there are threads.
 */
public final class InitialStateReader implements AutoCloseable {
    private static final int THREADS = 16;
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(2);

    private final Function<String, InitialState.State> reader;
    private final ExecutorService threads = Executors.newFixedThreadPool(THREADS, DaemonThreads.named("initial-state"));
    /** Reads that have not begun. */
    private final Map<String, Reading> next = new HashMap<>();
    /** Topics with a read that runs or is about to. */
    private final Set<String> busy = new HashSet<>();

    private static final class Reading {
        private final CompletableFuture<InitialState.State> state = new CompletableFuture<>();
        private int requests;
    }

    /** @param reader reads the initial state of a topic */
    public InitialStateReader(Function<String, InitialState.State> reader) {
        this.reader = reader;
    }

    /**
     * The state, of which each request must release its share once, as of a moment after this call, so that there is no gap between it and a stream that has begun.
     *
     * @throws java.util.concurrent.RejectedExecutionException if this is closed
     */
    public synchronized CompletableFuture<InitialState.State> read(String topic) {
        begin(topic);
        Reading reading = next.computeIfAbsent(topic, any -> new Reading());
        reading.requests++;
        return reading.state;
    }

    private void begin(String topic) {
        if (!busy.contains(topic)) {
            threads.execute(() -> readNext(topic));
            busy.add(topic);
        }
    }

    private void readNext(String topic) {
        Reading reading;
        synchronized (this) {
            reading = next.remove(topic);
        }
        try {
            InitialState.State state = reader.apply(topic);
            state.share().hold(reading.requests - 1);
            reading.state.complete(state);
        } catch (RuntimeException | Error e) { // otherwise the future never completes, and the topic stays busy
            reading.state.completeExceptionally(e);
        }
        synchronized (this) {
            busy.remove(topic);
            if (next.containsKey(topic) && !threads.isShutdown()) {
                begin(topic);
            }
        }
    }

    @Override
    public void close() {
        threads.shutdownNow();
        DaemonThreads.await(threads, CLOSE_TIMEOUT);
    }
}
