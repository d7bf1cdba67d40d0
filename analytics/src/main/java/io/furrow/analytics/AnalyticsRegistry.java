package io.furrow.analytics;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.coverage.CoverageJob;
import io.furrow.analytics.coverage.CoverageOptions;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.analytics.presence.PresenceJob;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureJob;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.model.result.AnalyticsKind;

/** Maps each kind of job to its options and its pipeline. */
public final class AnalyticsRegistry {
    private AnalyticsRegistry() {}

    /** The options to parse. */
    public static AnalyticsOptions options(AnalyticsKind kind) {
        return switch (kind) {
            case COLLISION -> new CollisionOptions();
            case COVERAGE -> new CoverageOptions();
            case PRESENCE -> new PresenceOptions();
            case TEMPERATURE -> new TemperatureOptions();
        };
    }

    /** @param options as parsed */
    public static StreamExecutionEnvironment assemble(AnalyticsOptions options) {
        return switch (options.kind()) {
            case COLLISION -> CollisionJob.assemble((CollisionOptions) options);
            case COVERAGE -> CoverageJob.assemble((CoverageOptions) options);
            case PRESENCE -> PresenceJob.assemble((PresenceOptions) options);
            case TEMPERATURE -> TemperatureJob.assemble((TemperatureOptions) options);
        };
    }
}
