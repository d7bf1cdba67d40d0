package io.furrow.control.rest;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.furrow.model.control.Response;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The answers of the managers by the id of their request: those that somebody waits for, and the newest {@value #REMEMBERED},
 * because a manager does not answer a repeated request again.
 */
final class Answers {
    static final int REMEMBERED = 100_000;

    private final Map<Key, CompletableFuture<Response>> awaited = new ConcurrentHashMap<>();
    private final Map<Kind, LongAdder> counts = new ConcurrentHashMap<>();
    private final Map<Key, byte[]> remembered = new LinkedHashMap<>() {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<Key, byte[]> eldest) {
            return size() > REMEMBERED;
        }
    };

    /** @param topic of the manager @param status of the answer */
    record Kind(String topic, String status) {}

    /** @param topic of the manager */
    record Key(String topic, String requestId) {}

    /** The future of whoever asked first and still waits, else null, and then the given one waits. */
    CompletableFuture<Response> await(Key key, CompletableFuture<Response> future) {
        return awaited.putIfAbsent(key, future);
    }

    void forget(Key key, CompletableFuture<Response> future) {
        awaited.remove(key, future);
    }

    int awaited() {
        return awaited.size();
    }

    boolean isAwaited(Key key) {
        return awaited.containsKey(key);
    }

    Optional<Response> known(Key key) {
        byte[] value;
        synchronized (remembered) {
            value = remembered.get(key);
        }
        try {
            return value == null ? Optional.empty() : Optional.of(Response.read(value));
        } catch (UnreadableException e) {
            throw new IllegalStateException("the remembered answer is none", e);
        }
    }

    void remember(Key key, byte[] answer) {
        synchronized (remembered) {
            remembered.put(key, answer);
        }
    }

    /** An answer that was read, of whomever. */
    void count(String topic, String status) {
        counts.computeIfAbsent(new Kind(topic, status), any -> new LongAdder()).increment();
    }

    /** How many were read since the start. */
    Map<Kind, LongAdder> counts() {
        return counts;
    }

    /** Tells whoever waits for it. */
    void release(Key key, Response answer) {
        CompletableFuture<Response> waiting = awaited.remove(key);
        if (waiting != null) {
            waiting.complete(answer);
        }
    }
}
