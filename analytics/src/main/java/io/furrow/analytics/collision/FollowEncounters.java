package io.furrow.analytics.collision;

import java.util.List;
import java.util.Optional;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.Inbox;
import io.furrow.analytics.eventtime.OneTimer;

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

    private transient OneTimer timer;
    private transient Inbox<Sighting> inbox;
    private transient ValueState<Meeting> meeting;
    private transient Counter violations;

    FollowEncounters(CollisionRules rules) {
        follower = new Follower(rules.exact());
    }

    @Override
    public void open(OpenContext context) {
        timer = new OneTimer(getRuntimeContext());
        inbox = new Inbox<>(getRuntimeContext(), Sighting.class, Sighting.SEQUENCE, timer);
        meeting = getRuntimeContext().getState(new ValueStateDescriptor<>("meeting", Meeting.class));
        violations = getRuntimeContext().getMetricGroup().counter("violations");
    }

    @Override
    public void processElement(Sighting sighting, Context context, Collector<Encounter> out) throws Exception {
        inbox.add(sighting, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Encounter> out) throws Exception {
        timer.rang();
        List<Sighting> due = inbox.takeDue(context.timerService());
        Follower.Followed followed = follower.follow(Optional.ofNullable(meeting.value()), due, out::collect);
        violations.inc(followed.violations());
        if (followed.meeting().isPresent()) {
            meeting.update(followed.meeting().get());
        } else {
            meeting.clear();
        }
    }
}
