package io.furrow.bench.replay;

import java.time.Duration;

/**
 * What is measured of the job {@code replay}.
 *
 * @param seconds that missions at speed 1 last
 * @param turns that count, after a shorter one that does not
 * @param parallelism of the job
 * @param checkpointInterval of the job
 */
public record ReplayBenchPlan(int seconds, int turns, int parallelism, Duration checkpointInterval) {
    /** At speed 1, before anything counts. */
    static final int WARM_UP_SECONDS = 10;
}
