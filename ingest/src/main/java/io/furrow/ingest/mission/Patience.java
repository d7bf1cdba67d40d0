package io.furrow.ingest.mission;

import java.io.IOException;
import java.time.Duration;
import java.util.concurrent.ThreadLocalRandom;

/** Pauses between attempts, doubling from 50 ms to 2 s, until the time is up. */
final class Patience {
    private static final long FIRST_MILLIS = 50;
    private static final long LONGEST_MILLIS = 2_000;

    private final Duration allowed;
    private long giveUpAt;
    private long pause = FIRST_MILLIS;

    Patience(Duration allowed) {
        this.allowed = allowed;
        this.giveUpAt = System.nanoTime() + allowed.toNanos();
    }

    /**
     * Waits before the next attempt.
     *
     * @throws IOException if there shall be none
     */
    void pauseAfter(Exception failure) throws IOException, InterruptedException {
        if (System.nanoTime() - giveUpAt >= 0) {
            throw new IOException(
                    "MongoDB did not take documents for %d s: %s. Check that it runs and what --mongo names."
                            .formatted(allowed.toSeconds(), failure.getMessage()),
                    failure);
        }
        pause();
    }

    /** Waits before the next attempt at a server that is there; the time for one that is away begins anew. */
    void pauseOfOneThatAnswers() throws InterruptedException {
        giveUpAt = System.nanoTime() + allowed.toNanos();
        pause();
    }

    private void pause() throws InterruptedException {
        Thread.sleep(pause + ThreadLocalRandom.current().nextLong(pause)); // apart from other writers that wait
        pause = Math.min(2 * pause, LONGEST_MILLIS);
    }
}
