package io.furrow.analytics.collision.debounce;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.eventtime.SingleTimer;

/**
 * Suppresses encounters that flicker. Key: the pair.
 *
 * <p><b>State</b>: the current encounter, whether it was emitted.
 *
 * <p><b>Cleared</b>: when the exact stages see its end.
 *
 * <p><b>Late</b>: impossible; the previous stage emits a pair in order of time and before the watermark.
 *
 * <p><b>Emits</b>: records of encounters that started within the threshold and lasted for the dwell.
 */
public final class DebounceEncounters extends KeyedProcessFunction<Pair, Encounter, Encounter> {
    private static final long serialVersionUID = 1L;

    private final EncounterDebouncer steadier;

    private transient SingleTimer timer;
    private transient ValueState<SteadyState> course;

    public DebounceEncounters(CollisionRules rules) {
        steadier = new EncounterDebouncer(rules);
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        course = getRuntimeContext().getState(new ValueStateDescriptor<>("course", SteadyState.class));
    }

    @Override
    public void processElement(Encounter seen, Context context, Collector<Encounter> out) throws Exception {
        keep(steadier.next(course.value(), seen, out::collect), context);
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Encounter> out) throws Exception {
        timer.rang();
        keep(steadier.advance(course.value(), context.timerService().currentWatermark(), out::collect), context);
    }

    private void keep(SteadyState now, Context context) throws Exception {
        course.update(now); // null clears
        Long due = steadier.due(now);
        if (due != null) {
            timer.ask(due, context.timerService());
        }
    }
}
