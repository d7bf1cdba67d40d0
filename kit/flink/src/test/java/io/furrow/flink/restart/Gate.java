package io.furrow.flink.restart;

import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;

import org.apache.flink.api.connector.source.SourceSplit;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiter;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiterStrategy;

/** Lets the records of the only source pass up to one of them, without blocking its task. */
final class Gate {
    private int next;
    private int limit;
    private CompletableFuture<Void> held;

    /** The source begins with this record and gets none for now. */
    synchronized void newRun(int first) {
        next = first;
        limit = first;
        held = null;
    }

    /** Lets all records before that one pass. */
    void open(int until) {
        CompletableFuture<Void> waiting = null;
        synchronized (this) {
            limit = until;
            if (next < limit) {
                waiting = held;
                held = null;
            }
        }
        if (waiting != null) {
            waiting.complete(null);
        }
    }

    synchronized void passed(int index) {
        next = index + 1;
    }

    /** Whether the record before that one has been forwarded. */
    synchronized boolean isAt(int until) {
        return next >= until && held != null;
    }

    private synchronized CompletionStage<Void> acquire() {
        if (next < limit) {
            return CompletableFuture.completedFuture(null);
        }
        held = new CompletableFuture<>();
        return held;
    }

    /** For the source, in the same JVM. */
    static final class Limit<S extends SourceSplit> implements RateLimiterStrategy<S> {
        private static final long serialVersionUID = 1L;

        @Override
        public RateLimiter<S> createRateLimiter(int parallelism) {
            return requested -> Input.GATE.acquire();
        }
    }
}
