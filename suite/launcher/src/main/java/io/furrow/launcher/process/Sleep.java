package io.furrow.launcher.process;

import java.time.Duration;

/** The pause between two polls. */
public final class Sleep {
    private Sleep() {}

    public static void of(Duration duration) {
        try {
            Thread.sleep(duration.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while waiting", e);
        }
    }
}
