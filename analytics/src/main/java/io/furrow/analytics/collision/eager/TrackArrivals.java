package io.furrow.analytics.collision.eager;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.grid.Track;
import io.furrow.analytics.collision.grid.Tracker;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

/**
 * Puts each device into the grid cells that have to know of it as soon as a position arrives. Key: the device.
 *
 * <p><b>State</b>: the newest position by event time, with its cells and version.
 *
 * <p><b>Cleared</b>: when the watermark has passed the position's time-to-live.
 *
 * <p><b>Late</b>: what is older than the newest is skipped; nothing here is exact.
 *
 * <p><b>Emits</b>: at once what becomes of the device in which cell.
 */
public final class TrackArrivals extends KeyedProcessFunction<Device, PositionFix, Arrival> {
    private static final long serialVersionUID = 1L;

    private final Tracker tracker;
    private transient ValueState<LatestTrack> newest;

    public TrackArrivals(CollisionRules rules) {
        tracker = new Tracker(rules);
    }

    @Override
    public void open(OpenContext context) {
        newest = getRuntimeContext().getState(new ValueStateDescriptor<>("newest", LatestTrack.class));
    }

    @Override
    public void processElement(PositionFix fix, Context context, Collector<Arrival> out) throws Exception {
        LatestTrack known = newest.value();
        if (known != null && PositionFix.SEQUENCE.compare(fix, known.track().last()) <= 0) {
            return;
        }
        long version = known == null ? fix.time() : Math.max(fix.time(), known.version() + 1);
        Track before = known == null ? null : known.track();
        Track now = tracker.move(
                before,
                fix,
                update -> out.collect(new Arrival(update.cell(), version, update.presence(), update.fix())));
        newest.update(new LatestTrack(now, version));
        if (known == null) {
            context.timerService().registerEventTimeTimer(tracker.expiry(now));
        }
    }

    @Override
    public void onTimer(long time, OnTimerContext context, Collector<Arrival> out) throws Exception {
        long end = tracker.expiry(newest.value().track());
        if (end <= context.timerService().currentWatermark()) {
            newest.clear();
        } else {
            context.timerService().registerEventTimeTimer(end);
        }
    }
}
