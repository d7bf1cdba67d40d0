package io.furrow.control.rest.view;

import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.kafka.BoundedMap;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Matches the answers of the managers with pending requests by request id, and caches the newest {@value #MAX_CACHED}
 * answers of each manager, because a manager does not answer a repeated request again. An answer belongs to the request
 * with the same fingerprint.
 */
public final class PendingReplies {
    static final int MAX_CACHED = 20_000;

    private final Map<Key, PendingRequest> pending = new ConcurrentHashMap<>();
    private final Map<Kind, LongAdder> counts = new ConcurrentHashMap<>();
    /**
     * Separate caches by topic: at the start one topic is read before the others, and the answers of a busy manager
     * would evict those of the others.
     */
    private final Map<String, Map<Key, CachedReply>> cached = new ConcurrentHashMap<>();

    /** @param topic of the manager @param status of the answer */
    public record Kind(String topic, String status) {}

    /** @param topic of the manager */
    record Key(String topic, String requestId) {}

    /** @param fingerprint of the pending request */
    record PendingRequest(String fingerprint, CompletableFuture<CommandResult> future) {}

    /** @param fingerprint of the answered request; null if an earlier version answered without it */
    private record CachedReply(String fingerprint, byte[] answer) {}

    /** Registers a pending request; returns the one that is already pending under this id, else null. */
    PendingRequest await(Key key, PendingRequest request) {
        return pending.putIfAbsent(key, request);
    }

    void forget(Key key, PendingRequest request) {
        pending.remove(key, request);
    }

    public int pending() {
        return pending.size();
    }

    /** Whether the request with this fingerprint is pending. @param fingerprint null if unknown */
    boolean isPending(Key key, String fingerprint) {
        PendingRequest request = pending.get(key);
        return request != null && (fingerprint == null || fingerprint.equals(request.fingerprint()));
    }

    /**
     * Returns the cached answer with this id.
     *
     * @throws ProblemException if it belongs to a request with another fingerprint
     */
    Optional<CommandResult> find(Key key, String fingerprint) {
        CachedReply reply;
        Map<Key, CachedReply> newest = newest(key);
        synchronized (newest) {
            reply = newest.get(key);
        }
        if (reply == null) {
            return Optional.empty();
        }
        if (reply.fingerprint() != null && !reply.fingerprint().equals(fingerprint)) {
            throw ProblemException.keyReused();
        }
        return Optional.of(NgsiJson.own(() -> CommandResult.read(reply.answer())));
    }

    /** Caches an answer. @param fingerprint of the request; null if unknown */
    void cache(Key key, String fingerprint, byte[] value, CommandResult answer) {
        String error = answer.error().orElse("");
        boolean isPermanent =
                !error.equals(ErrorCode.REQUEST_ID_REUSED.code()) && !error.equals(ErrorCode.OVERLOADED.code());
        if (isPermanent) {
            Map<Key, CachedReply> newest = newest(key);
            synchronized (newest) {
                newest.put(key, new CachedReply(fingerprint, value));
            }
        }
    }

    private Map<Key, CachedReply> newest(Key key) {
        return cached.computeIfAbsent(key.topic(), any -> BoundedMap.byInsertion(MAX_CACHED));
    }

    /** Counts an answer to any client. */
    void count(String topic, String status) {
        counts.computeIfAbsent(new Kind(topic, status), any -> new LongAdder()).increment();
    }

    /** Returns the number of answers since the start. */
    public Map<Kind, LongAdder> counts() {
        return counts;
    }

    /** Completes the pending request of an answer. */
    void release(Key key, CommandResult answer) {
        PendingRequest request = pending.remove(key);
        if (request != null) {
            request.future().complete(answer);
        }
    }
}
