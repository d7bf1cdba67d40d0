package io.furrow.flink.time;

import java.util.List;

import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.streaming.api.operators.co.CoBroadcastWithKeyedOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;

/** The same as {@link TimelessBroadcastOperator} for keyed events. */
public class KeyedTimelessBroadcastOperator<K, I, B, O> extends CoBroadcastWithKeyedOperator<K, I, B, O> {
    private static final long serialVersionUID = 1L;

    public KeyedTimelessBroadcastOperator(
            KeyedBroadcastProcessFunction<K, I, B, O> function, List<MapStateDescriptor<?, ?>> broadcastState) {
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
