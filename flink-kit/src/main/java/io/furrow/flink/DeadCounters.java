package io.furrow.flink;

import java.util.EnumMap;
import java.util.Map;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;

import io.furrow.model.ngsi.Reason;

/** Counts what an operator sets aside: {@code dead}, and the same in a group per {@code reason}. */
public final class DeadCounters {
    private final MetricGroup group;
    private final Counter all;
    private final Map<Reason, Counter> perReason = new EnumMap<>(Reason.class);

    public DeadCounters(MetricGroup group) {
        this.group = group;
        this.all = group.counter("dead");
    }

    public void count(Reason reason) {
        all.inc();
        perReason
                .computeIfAbsent(
                        reason, first -> group.addGroup("reason", first.code()).counter("dead"))
                .inc();
    }
}
