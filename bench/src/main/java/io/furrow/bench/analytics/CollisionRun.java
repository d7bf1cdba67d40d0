package io.furrow.bench.analytics;

import io.furrow.bench.analytics.load.CollisionPlan;

/**
 * What was measured of one plan.
 *
 * @param updatesPerSecond through all three stages
 * @param cpuMicros processor time of the whole JVM per update, in microseconds; other work on the machine moves it least
 * @param recordsPerUpdate records of encounters per update
 * @param bytesPerDevice of a savepoint in Flink's own form
 * @param barePerSecond updates per second of the bare loop in one thread
 * @param redis the same by Redis in a process of its own; null where it is not installed
 * @param secondsCompared seconds of event time whose starts were compared with the bare loop's
 * @param secondsDifferent of these, in how many the numbers differ: 0, or something is wrong
 */
public record CollisionRun(
        CollisionPlan plan,
        double updatesPerSecond,
        double cpuMicros,
        double recordsPerUpdate,
        double bytesPerDevice,
        double barePerSecond,
        RedisGeo.Result redis,
        int secondsCompared,
        int secondsDifferent) {
    /** Whether the pairs that were compared are the same in all of them. */
    boolean agrees() {
        return secondsDifferent == 0 && secondsCompared > 0 && (redis == null || redis.close() == redis.expected());
    }
}
