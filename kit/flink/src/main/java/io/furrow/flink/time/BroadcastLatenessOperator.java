package io.furrow.flink.time;

import java.util.List;

import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.streaming.api.watermark.Watermark;

/** The same as {@link KeyedLatenessOperator} for a function with a broadcast stream without event time. */
public final class BroadcastLatenessOperator<K, I, B, O> extends KeyedTimelessBroadcastOperator<K, I, B, O> {
    private static final long serialVersionUID = 1L;

    private transient EventTimeProgress reached;

    public <F extends KeyedBroadcastProcessFunction<K, I, B, O> & LatenessAware> BroadcastLatenessOperator(
            F function, List<MapStateDescriptor<?, ?>> broadcastState) {
        super(function, broadcastState);
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        reached = EventTimeProgress.restore(context.getOperatorStateStore(), getRuntimeContext());
        ((LatenessAware) userFunction).judgeBy(reached);
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        reached.advance(mark.getTimestamp());
        super.processWatermark(mark);
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        reached.snapshot();
    }
}
