package io.furrow.analytics.collision.grid;

import java.util.Comparator;
import java.util.List;

import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.Collector;
import org.apache.flink.util.OutputTag;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.collision.rules.RestoredRules;
import io.furrow.analytics.eventtime.EventTimeOperator;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.time.EventTimeProgress;

/**
 * Assigns each device to grid cells. Key: the device.
 *
 * <p><b>State</b>: positions that wait for the watermark, the newest valid one with its cells; the event time reached, because a restored
 * job starts without a watermark and must not fall behind its output.
 *
 * <p><b>Cleared</b>: when the position's time-to-live ends and none waits; when restored with changed rules, all but the waiting positions.
 *
 * <p><b>Late</b>: a position not after the watermark goes to {@link #LATE}, and to {@link #LAGGING} if the device has reported no newer
 * one. A position beyond the {@value #MAX_WAITING} waiting ones goes to {@code LATE} too, counted as {@code rejectedCrowded}.
 *
 * <p><b>Emits</b>: updates of cells, a device's in order of time, before the watermark that causes them.
 */
public final class TrackDevices extends EventTimeOperator<Device, PositionFix, Track, CellUpdate> {
    public static final OutputTag<PositionFix> LATE = new OutputTag<>("late") {
        private static final long serialVersionUID = 1L;
    };

    public static final OutputTag<LaggingPosition> LAGGING = new OutputTag<>("lagging") {
        private static final long serialVersionUID = 1L;
    };

    /** Maximum per device. */
    static final int MAX_WAITING = 100_000;

    private static final long serialVersionUID = 1L;

    private final Tracker tracker;
    private final CollisionRules rules;

    private transient RestoredRules restored;
    private transient EventTimeProgress reached;
    private transient Counter accepted;
    private transient Counter late;
    private transient Counter rejectedCrowded;

    public TrackDevices(CollisionRules rules) {
        super(new PendingFixesSerializer());
        this.rules = rules.exact();
        tracker = new Tracker(this.rules);
    }

    @Override
    protected Comparator<PositionFix> sequence() {
        return PositionFix.SEQUENCE;
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        reached = EventTimeProgress.restore(context.getOperatorStateStore(), getRuntimeContext());
        restored = RestoredRules.of(context.getOperatorStateStore(), rules);
    }

    @Override
    public void open() throws Exception {
        super.open();
        accepted = getMetricGroup().counter("accepted");
        late = getMetricGroup().counter("late");
        rejectedCrowded = getMetricGroup().counter("rejectedCrowded");
        if (restored.changed()) {
            forget(false, (track, out) -> {});
        }
    }

    @Override
    public void processElement(StreamRecord<PositionFix> record) throws Exception {
        PositionFix fix = record.getValue();
        if (reached.hasPassed(fix.time(), fix.device())) {
            late.inc();
            seeLagging(fix);
            output.collect(LATE, record);
        } else if (!offer(fix, MAX_WAITING)) {
            rejectedCrowded.inc();
            output.collect(LATE, record);
        } else {
            accepted.inc();
        }
    }

    private void seeLagging(PositionFix fix) {
        long counted = newest(fix.device(), track -> track.last().time());
        if (fix.time() <= counted) {
            return;
        }
        long passed = reached.of(fix.device());
        LaggingPosition lagging =
                new LaggingPosition(fix.topic(), fix.identity(), fix.id(), fix.mission(), fix.time(), passed, counted);
        output.collect(LAGGING, new StreamRecord<>(lagging, fix.time()));
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        reached.advance(mark.getTimestamp());
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
        reached.snapshot();
        restored.snapshot();
    }
}
