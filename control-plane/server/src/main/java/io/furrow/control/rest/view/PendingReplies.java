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
 * The answers of the managers by the id of their request: those that somebody waits for, and the newest {@value #REMEMBERED} of each manager,
 * because a manager does not answer a repeated request again. An answer belongs to the request with its fingerprint.
 */
public final class PendingReplies {
    static final int REMEMBERED = 20_000;

    private final Map<Key, Awaited> awaited = new ConcurrentHashMap<>();
    private final Map<Kind, LongAdder> counts = new ConcurrentHashMap<>();
    /** By topic: at the start one is read before the other, and the answers of a busy one would push those of the rest out. */
    private final Map<String, Map<Key, Remembered>> remembered = new ConcurrentHashMap<>();

    /** @param topic of the manager @param status of the answer */
    public record Kind(String topic, String status) {}

    /** @param topic of the manager */
    record Key(String topic, String requestId) {}

    /** @param fingerprint of the request that waits */
    record Awaited(String fingerprint, CompletableFuture<CommandResult> future) {}

    /** @param fingerprint of the request that was answered; null if an earlier version answered, which did not say */
    private record Remembered(String fingerprint, byte[] answer) {}

    /** Whoever asked first under this id and still waits, else null, and then the given one waits. */
    Awaited await(Key key, Awaited waiting) {
        return awaited.putIfAbsent(key, waiting);
    }

    void forget(Key key, Awaited waiting) {
        awaited.remove(key, waiting);
    }

    public int awaited() {
        return awaited.size();
    }

    /** Whether somebody waits for the answer to the request of this fingerprint. @param fingerprint null if it is not known */
    boolean isAwaited(Key key, String fingerprint) {
        Awaited waiting = awaited.get(key);
        return waiting != null && (fingerprint == null || fingerprint.equals(waiting.fingerprint()));
    }

    /**
     * The answer that was given under this id.
     *
     * @throws ProblemException where it was given to a request of another fingerprint
     */
    Optional<CommandResult> find(Key key, String fingerprint) {
        Remembered find;
        Map<Key, Remembered> newest = newest(key);
        synchronized (newest) {
            find = newest.get(key);
        }
        if (find == null) {
            return Optional.empty();
        }
        if (find.fingerprint() != null && !find.fingerprint().equals(fingerprint)) {
            throw ProblemException.keyReused();
        }
        return Optional.of(NgsiJson.own(() -> CommandResult.read(find.answer())));
    }

    /** @param fingerprint of the request; null if the answer does not say */
    void remember(Key key, String fingerprint, byte[] value, CommandResult answer) {
        String error = answer.error().orElse("");
        boolean isLasting =
                !error.equals(ErrorCode.REQUEST_ID_REUSED.code()) && !error.equals(ErrorCode.OVERLOADED.code());
        if (isLasting) {
            Map<Key, Remembered> newest = newest(key);
            synchronized (newest) {
                newest.put(key, new Remembered(fingerprint, value));
            }
        }
    }

    private Map<Key, Remembered> newest(Key key) {
        return remembered.computeIfAbsent(key.topic(), any -> BoundedMap.byInsertion(REMEMBERED));
    }

    /** An answer that was read, of whomever. */
    void count(String topic, String status) {
        counts.computeIfAbsent(new Kind(topic, status), any -> new LongAdder()).increment();
    }

    /** How many were read since the start. */
    public Map<Kind, LongAdder> counts() {
        return counts;
    }

    /** Completes the request that waits for it. */
    void release(Key key, CommandResult answer) {
        Awaited waiting = awaited.remove(key);
        if (waiting != null) {
            waiting.future().complete(answer);
        }
    }
}
