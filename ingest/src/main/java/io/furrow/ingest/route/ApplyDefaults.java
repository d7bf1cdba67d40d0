package io.furrow.ingest.route;

import org.apache.flink.api.common.functions.MapFunction;

/** Gives an event that names no domain or no mission the configured one. */
public final class ApplyDefaults implements MapFunction<ReportedEvent, ReportedEvent> {
    private static final long serialVersionUID = 1L;

    private final String defaultDomain;
    private final String defaultMission;

    /** Defaults are empty where there is none. */
    public ApplyDefaults(String defaultDomain, String defaultMission) {
        this.defaultDomain = defaultDomain;
        this.defaultMission = defaultMission;
    }

    @Override
    public ReportedEvent map(ReportedEvent event) {
        return event.belongingTo(
                event.domain().isEmpty() ? defaultDomain : event.domain(),
                event.mission().isEmpty() ? defaultMission : event.mission());
    }
}
