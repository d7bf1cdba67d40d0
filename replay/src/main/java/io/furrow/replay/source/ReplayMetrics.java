package io.furrow.replay.source;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.runtime.metrics.groups.AbstractMetricGroup;

import io.furrow.model.control.ReplayStatus;

/**
 * Registers the gauges of a reader: {@code replaysRunning}, and for each replay, from its newest status, {@code state}
 * (0 running, 1 paused, 2 ended, 3 stopped, 4 failed; −1 before the first), {@code position} in epoch ms of event time,
 * {@code lateness} and {@code slip} in ms, and {@code eventsPerSecond}.
 */
final class ReplayMetrics {
    private final MetricGroup reader;
    private final Map<RunningReplay, MetricGroup> groups = new ConcurrentHashMap<>();

    ReplayMetrics(MetricGroup reader) {
        this.reader = reader;
        Gauge<Long> replaysRunning = () -> groups.keySet().stream()
                .filter(replay -> replay.reports().state() == ReplayStatus.State.RUNNING.ordinal())
                .count();
        reader.gauge("replaysRunning", replaysRunning);
    }

    void add(RunningReplay replay) {
        MetricGroup group = reader.addGroup("replay", replay.name());
        Gauge<Integer> state = replay.reports()::state;
        Gauge<Long> position = replay.reports()::position;
        Gauge<Long> lateness = replay.reports()::lateness;
        Gauge<Long> slip = replay.reports()::slip;
        Gauge<Double> rate = replay.reports()::rate;
        group.gauge("state", state);
        group.gauge("position", position);
        group.gauge("lateness", lateness);
        group.gauge("slip", slip);
        group.gauge("eventsPerSecond", rate);
        groups.put(replay, group);
    }

    /** Closes the replay's group; otherwise Flink keeps its metrics as long as the task lives. */
    void remove(RunningReplay replay) {
        if (groups.remove(replay) instanceof AbstractMetricGroup<?> group) {
            group.close();
        }
    }
}
