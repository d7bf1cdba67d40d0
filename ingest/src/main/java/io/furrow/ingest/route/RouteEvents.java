package io.furrow.ingest.route;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichFlatMapFunction;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.flink.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/** Emits an event for its domain, and for its mission where it has one, value unchanged, stamped {@code ts-ingest}. */
final class RouteEvents extends RichFlatMapFunction<ReportedEvent, TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final String defaultDomain;
    private final String defaultMission;
    private transient Counter routed;
    private transient Counter unrouted;

    /** Defaults are empty where there is none. */
    RouteEvents(String defaultDomain, String defaultMission) {
        this.defaultDomain = defaultDomain;
        this.defaultMission = defaultMission;
    }

    @Override
    public void open(OpenContext context) {
        routed = getRuntimeContext().getMetricGroup().counter("routed");
        unrouted = getRuntimeContext().getMetricGroup().counter("unrouted");
    }

    @Override
    public void flatMap(ReportedEvent event, Collector<TopicRecord> out) {
        String domain = event.domain().isEmpty() ? defaultDomain : event.domain();
        String mission = event.mission().isEmpty() ? defaultMission : event.mission();
        if (domain.isEmpty()) {
            unrouted.inc();
            return;
        }
        // Wall clock: the stamp says when the event passed here, for measuring the delay of each hop.
        TopicRecord stamped = event.record().with(HeaderNames.TS_INGEST, Long.toString(System.currentTimeMillis()));
        out.collect(stamped.to(Topics.realtime(domain)));
        if (!mission.isEmpty()) {
            out.collect(stamped.to(Topics.realtime(domain, mission)));
        }
        routed.inc();
    }
}
