package io.furrow.analytics.presence;

import java.io.IOException;
import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.field.DeviceInFields;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.kafka.TopicSnapshot;

/**
 * Emits when devices enter and leave fields.
 *
 * <p><b>State</b>: beside that of {@link DeviceInFields} the presence; the event time reached, because a restored job starts without a
 * watermark and must not fall behind its output.
 *
 * <p><b>Cleared</b>: when the position's time-to-live has ended, the last {@code left} is emitted and no position waits.
 *
 * <p><b>Late</b>: see {@link DeviceInFields}. A version of a field that arrives too late for a device takes effect when the device is next
 * evaluated: with its next position, or within {@link #AGAIN} of event time.
 *
 * <p><b>Emits</b>: transitions, a device's in the order of the times at which they are certain, before the watermark of that time.
 */
public final class TrackPresence extends DeviceInFields<PositionFix, PresenceTransition> {
    /** Interval, in ms, at which a silent device is evaluated: a new version fires no timer of a key. */
    static final long AGAIN = 5_000;

    private static final long serialVersionUID = 1L;

    private final PresenceTracker judge;

    private transient ValueState<PresenceState> presence;

    public TrackPresence(PresenceRules rules, TopicSnapshot atStart) {
        super(atStart);
        this.judge = new PresenceTracker(rules);
    }

    @Override
    public void open(OpenContext context) throws IOException {
        super.open(context);
        presence = getRuntimeContext().getState(new ValueStateDescriptor<>("presence", PresenceState.class));
    }

    @Override
    protected EventTimeBuffer<PositionFix> eventTimeBuffer(SingleTimer timer) {
        return new EventTimeBuffer<>(getRuntimeContext(), PositionFix.class, PositionFix.SEQUENCE, timer);
    }

    @Override
    protected PositionFix fix(PositionFix report) {
        return report;
    }

    @Override
    protected long newestProcessed() throws IOException {
        PresenceState known = presence.value();
        return known == null || known.last() == null
                ? Long.MIN_VALUE
                : known.last().time();
    }

    @Override
    protected void advance(List<PositionFix> due, TimerService timers, Collector<PresenceTransition> out)
            throws Exception {
        long until = timers.currentWatermark();
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
