package io.furrow.suite;

import java.time.Duration;
import java.util.concurrent.Callable;

import org.awaitility.Awaitility;

/** Waits for many records as long as more of them come: how fast they come is the machine's affair. */
final class Arrivals {
    private static final Duration WITHOUT_ANY = Duration.ofSeconds(60);

    private Arrivals() {}

    /**
     * Returns when {@code seen} is at least {@code expected}.
     *
     * @throws org.awaitility.core.ConditionTimeoutException if a minute passes in which it does not grow
     */
    static void await(int expected, Callable<Integer> seen) {
        for (int arrived = 0; arrived < expected; ) {
            int before = arrived;
            arrived = Awaitility.await("more than %d of %d".formatted(before, expected))
                    .atMost(WITHOUT_ANY)
                    .until(seen, now -> now > before);
        }
    }
}
