package io.furrow.flink.kafka;

import java.io.IOException;
import java.io.InterruptedIOException;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentMap;
import java.util.concurrent.ExecutionException;

/**
 * Joins concurrent reads: a thread waits for the result of an equal read in progress. Results are not cached.
 *
 * @param <K> identifies equal reads
 * @param <V> the result; shared, so must not be modified
 */
final class SharedReads<K, V> {
    private final ConcurrentMap<K, CompletableFuture<V>> underWay = new ConcurrentHashMap<>();

    /** A read. */
    interface Read<V> {
        V run() throws IOException;
    }

    /** The result of the read in progress, else of this one; also of this one if the other fails. */
    V join(K key, Read<V> read) throws IOException {
        CompletableFuture<V> mine = new CompletableFuture<>();
        CompletableFuture<V> other = underWay.putIfAbsent(key, mine);
        if (other == null) {
            return lead(key, mine, read);
        }
        try {
            return other.get();
        } catch (ExecutionException e) { // its thread may have been stopped, which does not concern this one
            return read.run();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new InterruptedIOException("stopped while another thread was reading");
        }
    }

    private V lead(K key, CompletableFuture<V> mine, Read<V> read) throws IOException {
        try {
            V value = read.run();
            mine.complete(value);
            return value;
        } finally {
            underWay.remove(key);
            mine.completeExceptionally(new IOException("the read did not end")); // no effect where it did
        }
    }

    /** The number of reads in progress. */
    int size() {
        return underWay.size();
    }
}
