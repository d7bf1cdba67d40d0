package io.furrow.analytics;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;

/** A watermark after every event, so that a short job has as many as a long one. */
public final class EachEvent<T> implements WatermarkGenerator<T> {
    private final long bound;
    private long newest = Long.MIN_VALUE;

    public EachEvent(long bound) {
        this.bound = bound;
    }

    @Override
    public void onEvent(T event, long time, WatermarkOutput output) {
        newest = Math.max(newest, time);
        output.emitWatermark(new Watermark(newest - bound - 1));
    }

    @Override
    public void onPeriodicEmit(WatermarkOutput output) {}
}
