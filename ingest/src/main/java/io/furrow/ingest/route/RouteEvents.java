package io.furrow.ingest.route;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichFlatMapFunction;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.flink.TopicRecord;
import io.furrow.model.topic.Topics;

/** Emits an event for its domain, and for its mission where it has one. */
public final class RouteEvents extends RichFlatMapFunction<ReportedEvent, TopicRecord> {
    private static final long serialVersionUID = 1L;

    private transient Counter routed;
    private transient Counter unrouted;

    @Override
    public void open(OpenContext context) {
        routed = getRuntimeContext().getMetricGroup().counter("routed");
        unrouted = getRuntimeContext().getMetricGroup().counter("unrouted");
    }

    @Override
    public void flatMap(ReportedEvent event, Collector<TopicRecord> out) {
        if (event.domain().isEmpty()) {
            unrouted.inc();
            return;
        }
        out.collect(event.record().to(Topics.realtime(event.domain())));
        if (!event.mission().isEmpty()) {
            out.collect(event.record().to(Topics.realtime(event.domain(), event.mission())));
        }
        routed.inc();
    }
}
