package io.furrow.analytics.collision;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.PendingState;

/**
 * Tells the life of each encounter: started, ongoing, ended. Key: the pair.
 *
 * <p><b>State</b>: sightings that wait for the watermark; start, closest distance and newest report of an encounter.
 *
 * <p><b>Cleared</b>: when the encounter has ended and no sighting waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: records of encounters, a pair's in the order of their time. Instants at which the cells contradict each
 * other are counted as {@code violations}: always 0 unless the code is wrong.
 */
public final class FollowEncounters extends KeyedProcessFunction<String, Sighting, Encounter> {
    private static final long serialVersionUID = 1L;

    private final Follower follower;

    private transient PendingState<Sighting, Meeting> pair;
    private transient Counter violations;

    FollowEncounters(CollisionRules rules) {
        follower = new Follower(rules.exact());
    }

    @Override
    public void open(OpenContext context) {
        pair = new PendingState<>(getRuntimeContext(), new PendingSightingsFormat(), Sighting.SEQUENCE);
        violations = getRuntimeContext().getMetricGroup().counter("violations");
    }

    @Override
    public void processElement(Sighting sighting, Context context, Collector<Encounter> out) throws Exception {
        pair.add(sighting, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Encounter> out) throws Exception {
        pair.advance(
                time,
                context.timerService(),
                (before, due) -> {
                    Follower.Followed followed = follower.follow(before, due, out::collect);
                    violations.inc(followed.violations());
                    return followed.meeting();
                },
                remembered -> PendingState.NEVER);
    }
}
