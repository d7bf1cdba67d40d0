package io.furrow.analytics.collision;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.co.KeyedCoProcessFunction;
import org.apache.flink.util.Collector;

/**
 * Tells at once of pairs that are close by what has arrived, and names in the exact start what it confirms. Key: the pair.
 *
 * <p><b>State</b>: the newest glimpse's versions, and what is provisional.
 *
 * <p><b>Cleared</b>: when the pair is apart, all is decided, and the watermark has passed the newest versions.
 *
 * <p><b>Late</b>: a glimpse that knows less than the newest is passed over.
 *
 * <p><b>Emits</b>: the exact records as they are, but for what a start confirms; before them provisional records, each of
 * which a start confirms or a withdrawal follows once the watermark has passed it (and the dwell that a start waits for).
 */
final class RaiseAlarms extends KeyedCoProcessFunction<Pair, Encounter, Glimpse, Encounter> {
    private static final long serialVersionUID = 1L;

    private final long dwell;
    private transient ValueState<Alarm> alarm;

    RaiseAlarms(CollisionRules rules) {
        // A start comes at the first instant after its dwell.
        dwell = rules.steadiness().dwell().isZero()
                ? 0
                : rules.steadiness().dwell().toMillis() + 1;
    }

    @Override
    public void open(OpenContext context) {
        alarm = getRuntimeContext().getState(new ValueStateDescriptor<>("alarm", Alarm.class));
    }

    @Override
    public void processElement1(Encounter exact, Context context, Collector<Encounter> out) throws Exception {
        Alarm known = alarm.value();
        if (known == null || exact.phase() != Phase.STARTED) {
            out.collect(exact);
        } else {
            alarm.update(known.after(exact, out::collect));
        }
    }

    @Override
    public void processElement2(Glimpse glimpse, Context context, Collector<Encounter> out) throws Exception {
        Alarm known = alarm.value();
        Alarm now = (known == null ? Alarm.NONE : known).after(glimpse, provisional -> {
            context.timerService().registerEventTimeTimer(provisional.time() + dwell);
            out.collect(provisional);
        });
        alarm.update(now);
        if (!now.close()) {
            context.timerService().registerEventTimeTimer(now.lastVersion());
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Encounter> out) throws Exception {
        Alarm known = alarm.value();
        if (known == null) {
            return;
        }
        long watermark = context.timerService().currentWatermark();
        Alarm now = known.decided(watermark - dwell, out::collect);
        if (now.isOver(watermark)) {
            alarm.clear();
        } else {
            alarm.update(now);
        }
    }
}
