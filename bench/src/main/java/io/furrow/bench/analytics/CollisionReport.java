package io.furrow.bench.analytics;

import java.util.List;

/** What was measured of collision detection from memory, as figures. */
public record CollisionReport(List<CollisionRun> runs) {
    public Figures figures() {
        Figures figures = new Figures(
                "Collisions from memory: 5 m, 2 km x 2 km, random walk of 1 m a second, each device once a second");
        for (CollisionRun run : runs) {
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

    /** Whether every second that was compared has as many starts as the bare loop's, and Redis finds the pairs that the bare loop finds. */
    public boolean agrees() {
        return runs.stream().allMatch(CollisionRun::agrees);
    }
}
