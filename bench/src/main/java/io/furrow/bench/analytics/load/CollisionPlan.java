package io.furrow.bench.analytics.load;

import java.time.Duration;

/**
 * One measurement of collision detection.
 *
 * @param devices each reports once per second of event time
 * @param parallelism subtasks of each stage
 * @param warmUp before anything counts
 * @param measured for how long
 */
public record CollisionPlan(int devices, int parallelism, Duration warmUp, Duration measured) {}
