package io.furrow.analytics.collision.motion;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.eventtime.EventTimeBuffer;
import io.furrow.analytics.eventtime.SingleTimer;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.time.EventTimeProgress;
import io.furrow.flink.time.LatenessAware;

/**
 * Creates segments from the positions of each device and adds them to the cubes that they touch. Key: the device.
 *
 * <p><b>State</b>: positions that wait for the watermark, the newest with the segment that begins there; the event time
 * reached, because a restored job starts without a watermark.
 *
 * <p><b>Cleared</b>: when the position's time-to-live ends and none waits.
 *
 * <p><b>Late</b>: a position not after the watermark is counted as {@code late} and dropped; the stage that finds encounters
 * emits it as late.
 *
 * <p><b>Emits</b>: updates of cubes, a device's in order of time, before the watermark that causes them.
 * {@code positionsTooFast} counts positions whose distance from the previous one, or reported speed, exceeds the maximum speed.
 */
final class TrackMotion extends KeyedProcessFunction<String, PositionFix, SegmentUpdate> implements LatenessAware {
    private static final long serialVersionUID = 1L;
    /** Waiting positions per device; the stage that finds encounters emits further ones as late. */
    private static final int MAX_WAITING = 100_000;

    private final SegmentBuilder navigator;

    private transient SingleTimer timer;
    private transient EventTimeBuffer<PositionFix> eventTimeBuffer;
    private transient ValueState<MotionState> motion;
    private transient EventTimeProgress reached;
    private transient Counter late;
    private transient Counter tooFast;

    TrackMotion(MotionRules rules) {
        navigator = new SegmentBuilder(rules);
    }

    @Override
    public void judgeBy(EventTimeProgress reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) {
        timer = new SingleTimer(getRuntimeContext());
        eventTimeBuffer = new EventTimeBuffer<>(getRuntimeContext(), PositionFix.class, PositionFix.SEQUENCE, timer);
        motion = getRuntimeContext().getState(new ValueStateDescriptor<>("motion", MotionState.class));
        late = getRuntimeContext().getMetricGroup().counter("late");
        tooFast = getRuntimeContext().getMetricGroup().counter("positionsTooFast");
    }

    @Override
    public void processElement(PositionFix fix, Context context, Collector<SegmentUpdate> out) throws Exception {
        if (reached.hasPassed(fix.time(), context.getCurrentKey())
                || !eventTimeBuffer.offer(fix, MAX_WAITING, context.timerService())) {
            late.inc();
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<SegmentUpdate> out) throws Exception {
        timer.rang();
        long until = context.timerService().currentWatermark();
        List<PositionFix> due = eventTimeBuffer.takeDue(context.timerService());
        SegmentBuilder.Advanced advanced = navigator.advance(motion.value(), due, out::collect);
        tooFast.inc(advanced.tooFast());
        MotionState now = advanced.known();
        if (now == null || navigator.expiry(now) <= until) {
            motion.clear();
        } else {
            motion.update(now);
            timer.ask(navigator.expiry(now), context.timerService());
        }
    }
}
