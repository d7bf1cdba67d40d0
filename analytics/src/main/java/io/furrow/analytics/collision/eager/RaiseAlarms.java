package io.furrow.analytics.collision.eager;

import java.util.Comparator;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.co.KeyedCoProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.eventtime.Inbox;
import io.furrow.analytics.eventtime.OneTimer;

/**
 * Emits pairs that are close by the positions that have arrived, and refers to the alarm in the exact start that
 * confirms it. Key: the pair.
 *
 * <p><b>State</b>: exact records that wait, the newest glimpse's versions, and what is provisional.
 *
 * <p><b>Cleared</b>: when no record waits, the pair is apart or has not been seen for a time-to-live, all is decided, and the
 * watermark has passed the newest versions.
 *
 * <p><b>Late</b>: a glimpse that knows less than the newest is skipped.
 *
 * <p><b>Emits</b>: provisional records at once, each of which a start confirms or a withdrawal follows once the watermark has
 * passed it (and the dwell that a start waits for); the exact records as they are, but for what a start confirms, when the
 * watermark of both inputs has passed them: an exact record may overtake the glimpses of the very positions that it goes by.
 */
public final class RaiseAlarms extends KeyedCoProcessFunction<Pair, Encounter, ProvisionalProximity, Encounter> {
    private static final long serialVersionUID = 1L;

    private final long dwell;
    private final long timeToLive;
    private transient OneTimer timer;
    private transient Inbox<Encounter> exact;
    private transient ValueState<Alarm> alarm;

    public RaiseAlarms(CollisionRules rules) {
        timeToLive = rules.timeToLive().toMillis();
        // A start comes at the first instant after its dwell.
        dwell = rules.steadiness().dwell().isZero()
                ? 0
                : rules.steadiness().dwell().toMillis() + 1;
    }

    @Override
    public void open(OpenContext context) {
        timer = new OneTimer(getRuntimeContext());
        exact = new Inbox<>(getRuntimeContext(), Encounter.class, Comparator.comparingLong(Encounter::time), timer);
        alarm = getRuntimeContext().getState(new ValueStateDescriptor<>("alarm", Alarm.class));
    }

    @Override
    public void processElement1(Encounter encounter, Context context, Collector<Encounter> out) throws Exception {
        exact.add(encounter, context.timerService());
    }

    @Override
    public void processElement2(ProvisionalProximity glimpse, Context context, Collector<Encounter> out)
            throws Exception {
        Alarm now = known().after(glimpse, out::collect);
        remember(now, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Encounter> out) throws Exception {
        timer.rang();
        long watermark = context.timerService().currentWatermark();
        Alarm now = known();
        for (Encounter encounter : exact.takeDue(context.timerService())) {
            now = now.after(encounter, out::collect);
        }
        now = now.decided(watermark - dwell, out::collect);
        if (now.isOver(watermark, timeToLive)) {
            alarm.clear();
        } else {
            remember(now, context.timerService());
        }
    }

    private void remember(Alarm now, TimerService timers) throws Exception {
        alarm.update(now);
        timer.ask(now.nextDecision(dwell, timeToLive), timers);
    }

    private Alarm known() throws Exception {
        Alarm known = alarm.value();
        return known == null ? Alarm.NONE : known;
    }
}
