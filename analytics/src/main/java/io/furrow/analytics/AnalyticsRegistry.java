package io.furrow.analytics;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.presence.PresenceJob;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureJob;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.flink.job.JobOptions;
import io.furrow.model.result.AnalyticsKind;

/** Maps each kind of job to its options and its pipeline. */
public final class AnalyticsRegistry {
    private AnalyticsRegistry() {}

    /** The options to parse. */
    public static JobOptions options(AnalyticsKind kind) {
        return switch (kind) {
            case COLLISION -> new CollisionOptions();
            case PRESENCE -> new PresenceOptions();
            case TEMPERATURE -> new TemperatureOptions();
        };
    }

    /** @param options the parsed options of one of the kinds */
    public static StreamExecutionEnvironment assemble(JobOptions options) {
        if (options instanceof CollisionOptions collision) {
            return CollisionJob.assemble(collision);
        }
        return options instanceof PresenceOptions presence
                ? PresenceJob.assemble(presence)
                : TemperatureJob.assemble((TemperatureOptions) options);
    }
}
