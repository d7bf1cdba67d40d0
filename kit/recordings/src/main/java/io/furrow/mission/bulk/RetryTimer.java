package io.furrow.mission.bulk;

import java.io.IOException;
import java.time.Duration;
import java.util.concurrent.ThreadLocalRandom;

import io.furrow.model.time.Backoff;

/** Pauses between attempts, doubling from 50 ms to 2 s, until a timeout. */
final class RetryTimer {
    private static final Duration MIN_BACKOFF = Duration.ofMillis(50);
    private static final Duration MAX_BACKOFF = Duration.ofSeconds(2);

    private final Duration allowed;
    private final Backoff backoff = new Backoff(MIN_BACKOFF, MAX_BACKOFF);
    private long giveUpAt;

    RetryTimer(Duration allowed) {
        this.allowed = allowed;
        this.giveUpAt = System.nanoTime() + allowed.toNanos();
    }

    /**
     * Waits before the next attempt.
     *
     * @throws IOException after the timeout
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

    /** Waits before the next attempt at a server that answers, and restarts the timeout. */
    void pauseAndResetTimeout() throws InterruptedException {
        giveUpAt = System.nanoTime() + allowed.toNanos();
        pause();
    }

    private void pause() throws InterruptedException {
        long pause = backoff.next().toMillis();
        Thread.sleep(pause + ThreadLocalRandom.current().nextLong(pause)); // with jitter
    }
}
