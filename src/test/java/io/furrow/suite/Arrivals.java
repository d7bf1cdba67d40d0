package io.furrow.suite;

import java.time.Duration;
import java.util.concurrent.Callable;

import org.awaitility.Awaitility;

/** Waits for many records while more of them arrive, however fast the machine is. */
final class Arrivals {
    private static final Duration TIMEOUT = Duration.ofSeconds(60);

    private Arrivals() {}

    /**
     * Returns once {@code count} is at least {@code expected}.
     *
     * @throws org.awaitility.core.ConditionTimeoutException if it does not grow for a minute
     */
    static void await(int expected, Callable<Integer> count) {
        for (int arrived = 0; arrived < expected; ) {
            int previous = arrived;
            arrived = Awaitility.await("more than %d of %d".formatted(previous, expected))
                    .atMost(TIMEOUT)
                    .until(count, now -> now > previous);
        }
    }
}
