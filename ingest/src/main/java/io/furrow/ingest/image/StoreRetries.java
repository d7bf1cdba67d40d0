package io.furrow.ingest.image;

import java.io.IOException;
import java.time.Duration;

import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.time.Backoff;

/** Retries to store images, with backoff, until a timeout, so that a short outage of a store causes no restart. */
final class StoreRetries {
    private static final Duration MIN_BACKOFF = Duration.ofMillis(100);
    private static final Duration MAX_BACKOFF = Duration.ofSeconds(5);

    private final ImageMover mover;
    private final Duration timeout;
    private final Runnable onRetry;

    StoreRetries(ImageMover mover, Duration timeout, Runnable onRetry) {
        this.mover = mover;
        this.timeout = timeout;
        this.onRetry = onRetry;
    }

    /** @throws IOException the exception of the last attempt */
    MoveResult move(ReportedEvent event) throws IOException, InterruptedException {
        long end = System.nanoTime() + timeout.toNanos();
        Backoff backoff = new Backoff(MIN_BACKOFF, MAX_BACKOFF);
        while (true) {
            Duration pause = backoff.next();
            try {
                return mover.move(event);
            } catch (IOException e) {
                if (System.nanoTime() + pause.toNanos() > end) {
                    throw e;
                }
            }
            onRetry.run();
            Thread.sleep(pause.toMillis());
        }
    }
}
