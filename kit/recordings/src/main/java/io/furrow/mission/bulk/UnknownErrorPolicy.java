package io.furrow.mission.bulk;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;

/**
 * How long documents have been tried that MongoDB does not take with codes that say nothing of whose fault it is: they are given
 * up after long, or after a few attempts at their collection where the code was met before. Several threads share it.
 */
final class UnknownErrorPolicy {
    private static final int ATTEMPTS_OF_KNOWN = 3;

    private final Duration allowed;
    private final Set<Integer> known;
    private final Set<Integer> givenUp = new HashSet<>();
    private final Map<String, Integer> attempts = new HashMap<>();
    private long since;

    /** @param known codes of which a document was given up before, while others were taken */
    UnknownErrorPolicy(Duration allowed, Set<Integer> known) {
        this.allowed = allowed;
        this.known = known;
    }

    /** An attempt failed so; with the first one the time begins, for all collections. */
    synchronized void failed(String collection) {
        if (attempts.isEmpty()) {
            since = System.nanoTime();
        }
        attempts.merge(collection, 1, Integer::sum);
    }

    /** Whether a document is given up that fails with this code. */
    synchronized boolean isOver(String collection, int code) {
        return known.contains(code) && attempts.getOrDefault(collection, 0) >= ATTEMPTS_OF_KNOWN
                || !attempts.isEmpty() && System.nanoTime() - since >= allowed.toNanos();
    }

    /** A document was given up for this code. */
    synchronized void giveUp(int code) {
        givenUp.add(code);
    }

    synchronized Set<Integer> givenUp() {
        return Set.copyOf(givenUp);
    }
}
