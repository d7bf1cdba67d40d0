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
 * Finds the segments of each cube that come close to each other. Key: the cube's id.
 *
 * <p><b>State</b>: updates that wait for the watermark; of each device whose segments touch the cube, the segment ahead, and
 * those behind for one time-to-live, because another device may report with that delay what happened meanwhile.
 *
 * <p><b>Cleared</b>: when no segment can meet another any longer and no update waits.
 *
 * <p><b>Late</b>: impossible; the previous stage acts before it forwards a watermark.
 *
 * <p><b>Emits</b>: candidates about segments ahead; those about segments behind to {@link #CONTACTS}.
 */
final class MatchSegments extends KeyedProcessFunction<Long, SegmentUpdate, ApproachCandidate> {
    static final OutputTag<ApproachCandidate> CONTACTS = new OutputTag<>("contacts") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final MotionRules rules;
    private final Cubes cubes;
    private final long timeToLive;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<SegmentUpdate> eventTimeBuffer;
    private transient ValueState<CubeIndex> index;

    MatchSegments(MotionRules rules) {
        this.rules = rules;
        cubes = new Cubes(rules);
        timeToLive = rules.timeToLive();
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer =
                new EventTimeBuffer<>(getRuntimeContext(), SegmentUpdate.class, SegmentUpdate.SEQUENCE, timer);
        index = getRuntimeContext().getState(new ValueStateDescriptor<>("index", CubeIndex.class));
    }

    @Override
    public void processElement(SegmentUpdate update, Context context, Collector<ApproachCandidate> out)
            throws Exception {
        eventTimeBuffer.add(update, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<ApproachCandidate> out) throws Exception {
        timer.rang();
        List<SegmentUpdate> due = eventTimeBuffer.takeDue(context.timerService());
        CubeIndex known = index.value();
        CubeIndex now = known == null ? CubeIndex.empty() : known;
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
            index.clear();
        } else {
            index.update(now);
            timer.ask(now.nextEnd(timeToLive), context.timerService());
        }
    }
}
