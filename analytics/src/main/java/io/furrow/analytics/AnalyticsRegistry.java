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

/** The options and the job of each kind. */
public final class AnalyticsRegistry {
    private AnalyticsRegistry() {}

    /** Options to be parsed. */
    public static JobOptions options(AnalyticsKind kind) {
        return switch (kind) {
            case COLLISION -> new CollisionOptions();
            case PRESENCE -> new PresenceOptions();
            case TEMPERATURE -> new TemperatureOptions();
        };
    }

    /** @param options of one of the kinds, parsed */
    public static StreamExecutionEnvironment assemble(JobOptions options) {
        if (options instanceof CollisionOptions collision) {
            return CollisionJob.assemble(collision);
        }
        return options instanceof PresenceOptions presence
                ? PresenceJob.assemble(presence)
                : TemperatureJob.assemble((TemperatureOptions) options);
    }
}
