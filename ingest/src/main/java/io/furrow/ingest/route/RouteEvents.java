package io.furrow.ingest.route;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.job.PerMissionMetrics;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.topic.Topics;

/** Emits an event for its domain, and for its mission if it has one; measures throughput and delays. */
public final class RouteEvents extends ProcessFunction<ReportedEvent, TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final boolean writes;
    private transient Counter routed;
    private transient Counter unrouted;
    private transient PerMissionMetrics<RouteMeters> meters;

    /** @param writes if false, events are only measured */
    public RouteEvents(boolean writes) {
        this.writes = writes;
    }

    @Override
    public void open(OpenContext context) {
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        routed = metrics.counter("routed");
        unrouted = metrics.counter("unrouted");
        meters = new PerMissionMetrics<>(metrics, PerMissionMetrics.USUAL_LIMIT, RouteMeters::new);
    }

    @Override
    public void processElement(ReportedEvent event, Context context, Collector<TopicRecord> out) {
        boolean late = event.time() < context.timerService().currentWatermark();
        meters.of(event.domain(), event.mission()).count(event, late);
        if (event.domain().isEmpty()) {
            unrouted.inc();
            return;
        }
        routed.inc();
        if (writes) {
            out.collect(event.record().to(Topics.realtime(event.domain())));
            if (!event.mission().isEmpty()) {
                out.collect(event.record().to(Topics.realtime(event.domain(), event.mission())));
            }
        }
    }
}
