package io.furrow.analytics.collision.eager;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.matching.Matching;

/**
 * Spots the close pairs of each grid cell as soon as positions arrive. Key: the cell's id.
 *
 * <p><b>State</b>: the newest of each device in the cell and around it, who has left as a tombstone; the only timer's time.
 *
 * <p><b>Cleared</b>: a device when the watermark has passed its time-to-live or its tombstone; the cell with the last.
 *
 * <p><b>Late</b>: an arrival of a lower version than the known one is skipped.
 *
 * <p><b>Emits</b>: at once a glimpse of each pair that is close and of which either device changed, and of each that is no
 * more.
 */
public final class SpotPairs extends KeyedProcessFunction<Long, Arrival, ProvisionalProximity> {
    private static final long serialVersionUID = 1L;

    private final Matching matching;
    private final long timeToLive;
    private transient ValueState<Arrivals> arrivals;
    private transient ValueState<Long> timer;

    public SpotPairs(CollisionRules rules) {
        matching = new Matching(rules.whileBothCount());
        timeToLive = rules.timeToLive().toMillis();
    }

    @Override
    public void open(OpenContext context) {
        arrivals = getRuntimeContext().getState(new ValueStateDescriptor<>("arrivals", Arrivals.class));
        timer = getRuntimeContext().getState(new ValueStateDescriptor<>("timer", Types.LONG));
    }

    @Override
    public void processElement(Arrival arrival, Context context, Collector<ProvisionalProximity> out) throws Exception {
        Arrivals known = arrivals.value();
        Arrivals now = known == null ? new Arrivals() : known;
        now.apply(arrival, matching, out::collect);
        arrivals.update(now);
        ring(Arrivals.passes(arrival, timeToLive), context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<ProvisionalProximity> out) throws Exception {
        timer.clear();
        Arrivals now = arrivals.value();
        now.pass(context.timerService().currentWatermark(), timeToLive, matching, out::collect);
        if (now.isEmpty()) {
            arrivals.clear();
        } else {
            arrivals.update(now);
            ring(now.nextPass(timeToLive), context.timerService());
        }
    }

    /** At that time, or before where it was to ring before. */
    private void ring(long time, TimerService timers) throws Exception {
        Long set = timer.value();
        if (set == null || time < set) {
            if (set != null) {
                timers.deleteEventTimeTimer(set);
            }
            timers.registerEventTimeTimer(time);
            timer.update(time);
        }
    }
}
