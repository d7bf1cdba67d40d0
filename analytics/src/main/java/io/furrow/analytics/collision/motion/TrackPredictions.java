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
 * <p><b>State</b>: candidates that wait for the watermark; start, newest instant and newest report of a prediction.
 *
 * <p><b>Cleared</b>: when the prediction has not held for as long as the horizon and no candidate waits.
 *
 * <p><b>Late</b>: impossible; the previous stage acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: a record when a prediction is new, and at a limited rate while it lasts.
 */
final class TrackPredictions extends KeyedProcessFunction<String, ApproachCandidate, Approach> {
    private static final long serialVersionUID = 1L;

    private final MotionRules rules;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<ApproachCandidate> eventTimeBuffer;
    private transient ValueState<OngoingPrediction> prediction;

    TrackPredictions(MotionRules rules) {
        this.rules = rules;
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer =
                new EventTimeBuffer<>(getRuntimeContext(), ApproachCandidate.class, ApproachCandidate.SEQUENCE, timer);
        prediction = getRuntimeContext().getState(new ValueStateDescriptor<>("prediction", OngoingPrediction.class));
    }

    @Override
    public void processElement(ApproachCandidate candidate, Context context, Collector<Approach> out) throws Exception {
        eventTimeBuffer.add(candidate, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Approach> out) throws Exception {
        timer.rang();
        List<ApproachCandidate> due = eventTimeBuffer.takeDue(context.timerService());
        OngoingPrediction now = OngoingPrediction.follow(prediction.value(), due, rules, out::collect);
        if (now == null || now.lapse(rules) <= context.timerService().currentWatermark()) {
            prediction.clear();
        } else {
            prediction.update(now);
            timer.ask(now.lapse(rules), context.timerService());
        }
    }
}
