package io.furrow.analytics.collision;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.FunctionInitializationContext;
import org.apache.flink.runtime.state.FunctionSnapshotContext;
import org.apache.flink.streaming.api.checkpoint.CheckpointedFunction;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.Inbox;
import io.furrow.analytics.eventtime.OneTimer;

/**
 * Puts each device into the grid cells that have to know of it. Key: the device's identity.
 *
 * <p><b>State</b>: positions that wait for the watermark, the newest that counts with its cells; per subtask how far
 * event time has come, because a restored job starts without a watermark and must not go back behind what it has told.
 *
 * <p><b>Cleared</b>: when the position's time-to-live ends and none waits.
 *
 * <p><b>Late</b>: a position not after the watermark goes to {@link #LATE}.
 *
 * <p><b>Emits</b>: updates of cells, a device's in the order of their time, before the watermark that brings them about.
 */
public final class TrackDevices extends KeyedProcessFunction<String, PositionFix, CellUpdate>
        implements CheckpointedFunction {
    static final OutputTag<PositionFix> LATE = new OutputTag<>("late") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final Tracker tracker;

    private transient OneTimer timer;
    private transient Inbox<PositionFix> inbox;
    private transient ValueState<Track> track;
    private transient ListState<Long> progress;
    private transient long reached;
    private transient Counter accepted;
    private transient Counter late;

    TrackDevices(CollisionRules rules) {
        tracker = new Tracker(rules.exact());
    }

    @Override
    public void initializeState(FunctionInitializationContext context) throws Exception {
        progress = context.getOperatorStateStore()
                .getUnionListState(new ListStateDescriptor<>("event-time-reached", Types.LONG));
        reached = Long.MIN_VALUE;
        for (long each : progress.get()) {
            reached = Math.max(reached, each);
        }
    }

    @Override
    public void open(OpenContext context) {
        timer = new OneTimer(getRuntimeContext());
        inbox = new Inbox<>(getRuntimeContext(), PositionFix.class, PositionFix.SEQUENCE, timer);
        track = getRuntimeContext().getState(new ValueStateDescriptor<>("track", Track.class));
        accepted = getRuntimeContext().getMetricGroup().counter("accepted");
        late = getRuntimeContext().getMetricGroup().counter("late");
    }

    @Override
    public void processElement(PositionFix fix, Context context, Collector<CellUpdate> out) throws Exception {
        reached = Math.max(reached, context.timerService().currentWatermark());
        if (fix.time() <= reached) {
            late.inc();
            context.output(LATE, fix);
            return;
        }
        accepted.inc();
        inbox.add(fix, context.timerService());
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<CellUpdate> out) throws Exception {
        timer.rang();
        long until = context.timerService().currentWatermark();
        reached = Math.max(reached, until);
        List<PositionFix> due = inbox.takeDue(context.timerService());
        Track before = track.value();
        Track after = tracker.advance(before == null ? Track.NOWHERE : before, due, until, out::collect);
        if (after.isNowhere()) {
            track.clear();
        } else {
            track.update(after);
            timer.ask(tracker.expiry(after), context.timerService());
        }
    }

    @Override
    public void snapshotState(FunctionSnapshotContext context) throws Exception {
        progress.update(List.of(reached));
    }
}
