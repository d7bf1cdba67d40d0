package io.furrow.mission.bulk;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;

/**
 * Decides how long to retry documents that MongoDB rejects with unknown codes: until a timeout, or for a few attempts
 * per collection if the code is known to be caused by documents. Thread-safe.
 */
final class UnknownErrorPolicy {
    private static final int MAX_ATTEMPTS = 3;

    private final Duration allowed;
    private final Set<Integer> documentErrorCodes;
    private final Set<Integer> givenUp = new HashSet<>();
    private final Map<String, Integer> attempts = new HashMap<>();
    private long since;

    /** @param documentErrorCodes codes for which a document was given up before while others were accepted */
    UnknownErrorPolicy(Duration allowed, Set<Integer> documentErrorCodes) {
        this.allowed = allowed;
        this.documentErrorCodes = documentErrorCodes;
    }

    /** Counts a failed attempt; the first one starts the timeout for all collections. */
    synchronized void failed(String collection) {
        if (attempts.isEmpty()) {
            since = System.nanoTime();
        }
        attempts.merge(collection, 1, Integer::sum);
    }

    /** Returns whether a document with this code is given up. */
    synchronized boolean isExhausted(String collection, int code) {
        return documentErrorCodes.contains(code) && attempts.getOrDefault(collection, 0) >= MAX_ATTEMPTS
                || !attempts.isEmpty() && System.nanoTime() - since >= allowed.toNanos();
    }

    /** Records that a document was given up for this code. */
    synchronized void giveUp(int code) {
        givenUp.add(code);
    }

    synchronized Set<Integer> givenUp() {
        return Set.copyOf(givenUp);
    }
}
