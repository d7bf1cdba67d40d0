package io.furrow.ingest.image;

import java.io.IOException;
import java.time.Duration;

import io.furrow.ingest.route.ReportedEvent;

/** Tries to store images again for a while, at growing intervals: a store that is away for a moment costs no restart. */
final class StoreAttempts {
    private static final long FIRST_PAUSE_MILLIS = 100;
    private static final long LONGEST_PAUSE_MILLIS = 5_000;

    private final ImageMover mover;
    private final Duration patience;
    private final Runnable onRetry;

    StoreAttempts(ImageMover mover, Duration patience, Runnable onRetry) {
        this.mover = mover;
        this.patience = patience;
        this.onRetry = onRetry;
    }

    /** @throws IOException what the last attempt said */
    Moved move(ReportedEvent event) throws IOException, InterruptedException {
        long end = System.nanoTime() + patience.toNanos();
        for (long pause = FIRST_PAUSE_MILLIS; ; pause = Math.min(2 * pause, LONGEST_PAUSE_MILLIS)) {
            try {
                return mover.move(event);
            } catch (IOException e) {
                if (System.nanoTime() + Duration.ofMillis(pause).toNanos() > end) {
                    throw e;
                }
            }
            onRetry.run();
            Thread.sleep(pause);
        }
    }
}
