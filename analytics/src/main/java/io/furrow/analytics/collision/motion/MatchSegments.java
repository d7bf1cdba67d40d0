package io.furrow.analytics.collision.motion;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;

/**
 * Finds the legs of each cube that come close to each other. Key: the cube's id.
 *
 * <p><b>State</b>: updates that wait for the watermark; of each device whose legs touch the cube the leg ahead, and those
 * behind for one time-to-live, because another device may report as late as that what happened meanwhile.
 *
 * <p><b>Cleared</b>: when the last leg can meet nothing any more and no update waits.
 *
 * <p><b>Late</b>: nothing can be, the stage before acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: findings about legs ahead; those about legs behind to {@link #CONTACTS}.
 */
final class MatchSegments extends KeyedProcessFunction<Long, LegUpdate, Finding> {
    static final OutputTag<Finding> CONTACTS = new OutputTag<>("contacts") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final MotionRules rules;
    private final Cubes cubes;
    private final long timeToLive;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<LegUpdate> eventTimeBuffer;
    private transient ValueState<Neighbourhood> neighbourhood;

    MatchSegments(MotionRules rules) {
        this.rules = rules;
        cubes = new Cubes(rules);
        timeToLive = rules.timeToLive();
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), LegUpdate.class, LegUpdate.SEQUENCE, timer);
        neighbourhood = getRuntimeContext().getState(new ValueStateDescriptor<>("neighbourhood", Neighbourhood.class));
    }

    @Override
    public void processElement(LegUpdate update, Context context, Collector<Finding> out) throws Exception {
        eventTimeBuffer.add(update, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Finding> out) throws Exception {
        timer.rang();
        List<LegUpdate> due = eventTimeBuffer.takeDue(context.timerService());
        Neighbourhood known = neighbourhood.value();
        Neighbourhood now = known == null ? Neighbourhood.empty() : known;
        now.apply(
                due,
                new ApproachDetector(
                        rules,
                        cubes,
                        context.getCurrentKey(),
                        out::collect,
                        contact -> context.output(CONTACTS, contact)));
        now.forget(context.timerService().currentWatermark(), timeToLive);
        if (now.isEmpty()) {
            neighbourhood.clear();
        } else {
            neighbourhood.update(now);
            timer.ask(now.nextEnd(timeToLive), context.timerService());
        }
    }
}
