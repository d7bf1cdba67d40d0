package io.furrow.ingest.mission;

import java.time.Duration;
import java.util.HashSet;
import java.util.Set;

/**
 * How long documents have been tried that MongoDB does not take with codes that say nothing of whose fault it is: they are given
 * up after long, or after a few attempts where the code was met before.
 */
final class Doubt {
    private static final int ATTEMPTS_OF_KNOWN = 3;

    private final Duration allowed;
    private final Set<Integer> known;
    private final Set<Integer> givenUp = new HashSet<>();
    private long since;
    private int attempts;

    /** @param known codes of which a document was given up before, while others were taken */
    Doubt(Duration allowed, Set<Integer> known) {
        this.allowed = allowed;
        this.known = known;
    }

    /** An attempt failed so; with the first one the time begins. */
    void failed() {
        if (attempts++ == 0) {
            since = System.nanoTime();
        }
    }

    /** Whether a document is given up that fails with this code. */
    boolean isOver(int code) {
        return known.contains(code) && attempts >= ATTEMPTS_OF_KNOWN
                || attempts > 0 && System.nanoTime() - since >= allowed.toNanos();
    }

    /** A document was given up for this code. */
    void giveUp(int code) {
        givenUp.add(code);
    }

    Set<Integer> givenUp() {
        return givenUp;
    }
}
