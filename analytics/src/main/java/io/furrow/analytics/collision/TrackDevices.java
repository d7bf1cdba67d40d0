package io.furrow.analytics.collision;

import java.util.List;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.FunctionInitializationContext;
import org.apache.flink.runtime.state.FunctionSnapshotContext;
import org.apache.flink.streaming.api.checkpoint.CheckpointedFunction;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.PendingState;

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

    /** Every position that is not late, as soon as it arrives. */
    static final OutputTag<PositionFix> ACCEPTED = new OutputTag<>("accepted") {
        private static final long serialVersionUID = 1L;
    };

    private static final long serialVersionUID = 1L;

    private final boolean eager;
    private final Tracker tracker;

    private transient PendingState<PositionFix, Track> device;
    private transient ListState<Long> progress;
    private transient long reached;
    private transient Counter accepted;
    private transient Counter late;

    TrackDevices(CollisionRules rules) {
        this(rules, false);
    }

    /** @param eager whether {@link #ACCEPTED} is wanted */
    TrackDevices(CollisionRules rules, boolean eager) {
        this.eager = eager;
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
        device = new PendingState<>(getRuntimeContext(), new PendingFixesFormat(), PositionFix.SEQUENCE);
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
        device.add(fix, context.timerService());
        if (eager) {
            context.output(ACCEPTED, fix);
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<CellUpdate> out) throws Exception {
        long until = context.timerService().currentWatermark();
        reached = Math.max(reached, until);
        device.advance(
                time,
                context.timerService(),
                (before, due) -> tracker.advance(before, due, until, out::collect),
                tracker::expiry);
    }

    @Override
    public void snapshotState(FunctionSnapshotContext context) throws Exception {
        progress.update(List.of(reached));
    }
}
