package io.furrow.analytics.collision;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.eventtime.EventTimeOperator;

/**
 * Puts each device into the grid cells that have to know of it. Key: the device.
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
public final class TrackDevices extends EventTimeOperator<Device, PositionFix, Track, CellUpdate> {
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

    private transient ListState<Long> progress;
    private transient long reached;
    private transient Counter accepted;
    private transient Counter late;

    TrackDevices(CollisionRules rules) {
        this(rules, false);
    }

    /** @param eager whether {@link #ACCEPTED} is wanted */
    TrackDevices(CollisionRules rules, boolean eager) {
        super(new PendingFixesFormat());
        this.eager = eager;
        tracker = new Tracker(rules.exact());
    }

    @Override
    protected Comparator<PositionFix> sequence() {
        return PositionFix.SEQUENCE;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        progress = context.getOperatorStateStore()
                .getUnionListState(new ListStateDescriptor<>("event-time-reached", Types.LONG));
        reached = Long.MIN_VALUE;
        for (long each : progress.get()) {
            reached = Math.max(reached, each);
        }
    }

    @Override
    public void open() throws Exception {
        super.open();
        accepted = getMetricGroup().counter("accepted");
        late = getMetricGroup().counter("late");
    }

    @Override
    public void processElement(StreamRecord<PositionFix> record) throws Exception {
        if (record.getValue().time() <= reached) {
            late.inc();
            output.collect(LATE, record);
            return;
        }
        accepted.inc();
        super.processElement(record);
        if (eager) {
            output.collect(ACCEPTED, record);
        }
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        reached = Math.max(reached, mark.getTimestamp());
        super.processWatermark(mark);
    }

    @Override
    protected Track apply(Device device, Track before, List<PositionFix> due, long until, Collector<CellUpdate> out) {
        return tracker.advance(before, due, until, out::collect);
    }

    @Override
    protected long expiry(Track track) {
        return tracker.expiry(track);
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        progress.update(List.of(reached));
    }
}
