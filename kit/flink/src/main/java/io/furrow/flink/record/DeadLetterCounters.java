package io.furrow.flink.record;

import java.util.EnumMap;
import java.util.Map;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;

import io.furrow.flink.job.PerMissionMetrics;
import io.furrow.model.ngsi.Reason;

/**
 * Counts an operator's dead letters: {@code dead}, the same in a group per {@code reason}, and, if assigned, in groups per
 * {@code domain} and {@code mission}.
 */
public final class DeadLetterCounters {
    private final MetricGroup group;
    private final Counter all;
    private final PerMissionMetrics<Counter> perMissionMetrics;
    private final Map<Reason, Counter> perReason = new EnumMap<>(Reason.class);

    public DeadLetterCounters(MetricGroup group) {
        this.group = group;
        this.all = group.counter("dead");
        this.perMissionMetrics =
                new PerMissionMetrics<>(group, PerMissionMetrics.USUAL_LIMIT, mission -> mission.counter("dead"));
    }

    public void count(Reason reason) {
        all.inc();
        perReason
                .computeIfAbsent(
                        reason, first -> group.addGroup("reason", first.code()).counter("dead"))
                .inc();
    }

    /** The same with domain and mission; each may be empty. */
    public void count(Reason reason, String domain, String mission) {
        count(reason);
        perMissionMetrics.of(domain, mission).inc();
    }
}
