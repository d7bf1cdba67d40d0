package io.furrow.flink.time;

import java.util.List;

import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.streaming.api.functions.co.BroadcastProcessFunction;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithNonKeyedOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;

/**
 * Joins events with a broadcast stream without event time. The watermark is that of the events alone: lateness does not depend
 * on the broadcast stream, idle, ahead or behind. The output is idle when both are.
 */
public final class TimelessBroadcastOperator<I, B, O> extends CoBroadcastWithNonKeyedOperator<I, B, O> {
    private static final long serialVersionUID = 1L;

    public TimelessBroadcastOperator(
            BroadcastProcessFunction<I, B, O> function, List<MapStateDescriptor<?, ?>> broadcastState) {
        super(function, broadcastState);
    }

    @Override
    public void open() throws Exception {
        super.open();
        super.processWatermarkStatus2(WatermarkStatus.IDLE);
    }

    @Override
    public void processWatermark1(Watermark mark) throws Exception {
        processWatermark(mark); // not the lower one of both inputs
    }

    @Override
    public void processWatermark2(Watermark mark) {
        // The broadcast stream has no event time.
    }
}
