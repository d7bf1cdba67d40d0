package io.furrow.analytics.collision.motion;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;

/**
 * Emits the life cycle of each prediction. Key: the pair.
 *
 * <p><b>State</b>: findings that wait for the watermark; start, newest instant and newest report of a prediction.
 *
 * <p><b>Cleared</b>: when the prediction has not held for as long as the horizon and no finding waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: a record when a prediction is new, and at a limited rate while it lasts.
 */
final class TrackPredictions extends KeyedProcessFunction<String, Finding, Approach> {
    private static final long serialVersionUID = 1L;

    private final MotionRules rules;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<Finding> eventTimeBuffer;
    private transient ValueState<OngoingPrediction> foretold;

    TrackPredictions(MotionRules rules) {
        this.rules = rules;
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), Finding.class, Finding.SEQUENCE, timer);
        foretold = getRuntimeContext().getState(new ValueStateDescriptor<>("foretold", OngoingPrediction.class));
    }

    @Override
    public void processElement(Finding finding, Context context, Collector<Approach> out) throws Exception {
        eventTimeBuffer.add(finding, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Approach> out) throws Exception {
        timer.rang();
        List<Finding> due = eventTimeBuffer.takeDue(context.timerService());
        OngoingPrediction now = OngoingPrediction.follow(foretold.value(), due, rules, out::collect);
        if (now == null || now.lapse(rules) <= context.timerService().currentWatermark()) {
            foretold.clear();
        } else {
            foretold.update(now);
            timer.ask(now.lapse(rules), context.timerService());
        }
    }
}
