package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.List;

import io.furrow.bench.frame.Figures;

/** The results of measuring collision detection from memory. */
record CollisionReport(List<Run> runs) {
    /**
     * One measurement.
     *
     * @param devices each reports once per second of event time
     * @param parallelism subtasks of each stage
     * @param warmUp before the measurement
     * @param measured its duration
     */
    record Plan(int devices, int parallelism, Duration warmUp, Duration measured) {}

    /**
     * The results of one plan.
     *
     * @param updatesPerSecond through all three stages
     * @param cpuMicros processor time of the whole JVM per update, in microseconds; the figure least affected by other load
     * @param recordsPerUpdate records of encounters per update
     * @param bytesPerDevice of a savepoint in Flink's native format
     * @param barePerSecond updates per second of the bare loop in one thread
     * @param redis the same with Redis in its own process; null if it is not installed
     * @param secondsCompared seconds of event time whose starts were compared with the bare loop's
     * @param secondsDifferent number of these that differ: 0, or something is wrong
     */
    record Run(
            Plan plan,
            double updatesPerSecond,
            double cpuMicros,
            double recordsPerUpdate,
            double bytesPerDevice,
            double barePerSecond,
            RedisGeo.Result redis,
            int secondsCompared,
            int secondsDifferent) {
        private boolean agrees() {
            return secondsDifferent == 0 && secondsCompared > 0 && (redis == null || redis.close() == redis.expected());
        }
    }

    Figures figures() {
        Figures figures = new Figures(
                "Collisions from memory: 5 m, 2 km x 2 km, random walk of 1 m a second, each device once a second");
        for (Run run : runs) {
            RedisGeo.Result redis = run.redis();
            figures.add(
                    "devices", run.plan().devices(),
                    "cores", run.plan().parallelism(),
                    "updates/s", run.updatesPerSecond(),
                    "cpu us", run.cpuMicros(),
                    "records", run.recordsPerUpdate(),
                    "bytes", run.bytesPerDevice(),
                    "bare loop", run.barePerSecond(),
                    "Redis GEO", redis == null ? "not installed" : redis.perSecond(),
                    "pairs", redis == null ? "–" : redis.close() + "/" + redis.expected(),
                    "differ", run.secondsDifferent() + "/" + run.secondsCompared());
        }
        return figures;
    }

    /** Whether every compared second has as many starts as in the bare loop, and Redis finds the bare loop's pairs. */
    boolean agrees() {
        return runs.stream().allMatch(Run::agrees);
    }
}
