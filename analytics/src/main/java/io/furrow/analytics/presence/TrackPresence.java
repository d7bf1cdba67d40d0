package io.furrow.analytics.presence;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.EventTimeProgress;
import io.furrow.flink.time.LatenessAware;

/**
 * Emits when devices enter and leave fields. Key: the device of a topic.
 *
 * <p><b>State</b>: positions that wait for the watermark, the presence; the event time reached, because a restored job starts without a
 * watermark and must not fall behind its output. Fields: see {@link FieldVersions}.
 *
 * <p><b>Cleared</b>: when the position's time-to-live has ended, the last {@code left} is emitted and no position waits.
 *
 * <p><b>Late</b>: a position not after the watermark goes to {@link #LATE}, and to {@link #LAGGING} if the device has reported no newer
 * one. A position beyond the {@value #MAX_WAITING} waiting ones goes to {@code LATE} too, counted as {@code rejectedCrowded}. A version of a
 * field that arrives too late for a device takes effect when the device is next evaluated: with its next position, or within {@link #AGAIN}
 * of event time.
 *
 * <p><b>Emits</b>: transitions, a device's in the order of the times at which they are certain, before the watermark of that time.
 */
public final class TrackPresence
        extends KeyedBroadcastProcessFunction<String, PositionFix, TopicRecord, PresenceTransition>
        implements LatenessAware {
    static final OutputTag<PositionFix> LATE = new OutputTag<>("late") {
        private static final long serialVersionUID = 1L;
    };
    static final OutputTag<LaggingPosition> LAGGING = new OutputTag<>("lagging") {
        private static final long serialVersionUID = 1L;
    };
    /** Maximum per device. */
    static final int MAX_WAITING = 100_000;
    /** Interval, in ms, at which a silent device is evaluated: a new version fires no timer of a key. */
    static final long AGAIN = 5_000;

    private static final long serialVersionUID = 1L;

    private final PresenceTracker judge;
    private final TopicSnapshot atStart;

    private transient FieldVersions fields;
    private transient SingleTimer timer;
    private transient EventTimeBuffer<PositionFix> eventTimeBuffer;
    private transient ValueState<PresenceState> presence;
    private transient EventTimeProgress reached;
    private transient Counter accepted;
    private transient Counter late;
    private transient Counter rejectedCrowded;
    private transient Counter changes;

    public TrackPresence(PresenceRules rules, TopicSnapshot atStart) {
        this.judge = new PresenceTracker(rules);
        this.atStart = atStart;
    }

    @Override
    public void judgeBy(EventTimeProgress reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) throws IOException {
        fields = FieldVersions.read(atStart);
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), PositionFix.class, PositionFix.SEQUENCE, timer);
        presence = getRuntimeContext().getState(new ValueStateDescriptor<>("presence", PresenceState.class));
        accepted = getRuntimeContext().getMetricGroup().counter("accepted");
        late = getRuntimeContext().getMetricGroup().counter("late");
        rejectedCrowded = getRuntimeContext().getMetricGroup().counter("rejectedCrowded");
        changes = getRuntimeContext().getMetricGroup().counter("fieldChanges");
    }

    @Override
    public void processElement(PositionFix fix, ReadOnlyContext context, Collector<PresenceTransition> out)
            throws Exception {
        if (reached.hasPassed(fix.time(), context.getCurrentKey())) {
            late.inc();
            context.output(LATE, fix);
            seeLagging(fix, context);
        } else if (eventTimeBuffer.offer(fix, MAX_WAITING, context.timerService())) {
            accepted.inc();
        } else {
            rejectedCrowded.inc();
            context.output(LATE, fix);
        }
    }

    private void seeLagging(PositionFix fix, ReadOnlyContext context) throws Exception {
        PresenceState known = presence.value();
        long last = known == null || known.last() == null
                ? Long.MIN_VALUE
                : known.last().time();
        long counted = Math.max(last, eventTimeBuffer.newest());
        if (fix.time() > counted) {
            context.output(
                    LAGGING,
                    new LaggingPosition(
                            fix.topic(),
                            fix.identity(),
                            fix.id(),
                            fix.mission(),
                            fix.time(),
                            reached.of(context.getCurrentKey()),
                            counted));
        }
    }

    @Override
    public void processBroadcastElement(TopicRecord version, Context context, Collector<PresenceTransition> out) {
        if (fields.take(version)) {
            changes.inc();
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<PresenceTransition> out) throws Exception {
        timer.rang();
        TimerService timers = context.timerService();
        long until = timers.currentWatermark();
        List<PositionFix> due = eventTimeBuffer.takeDue(timers);
        PresenceState before = presence.value();
        PresenceState now =
                judge.advance(before == null ? PresenceState.NOWHERE : before, due, until, fields, out::collect);
        if (due.isEmpty()) {
            now = judge.again(now, until, fields, out::collect);
        }
        if (now.isNowhere()) {
            presence.clear();
        } else {
            presence.update(now);
            timer.ask(judge.nextInstant(now, fields), timers);
            timer.ask(until + AGAIN, timers);
        }
    }
}
