package io.furrow.flink.time;

import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;

/**
 * Runs a keyed function that handles late events. The operator receives every watermark, a function sees only those at which
 * an event arrives or a timer fires; the operator therefore stores the event time reached.
 */
public final class KeyedLatenessOperator<K, I, O> extends KeyedProcessOperator<K, I, O> {
    private static final long serialVersionUID = 1L;

    private transient EventTimeProgress reached;

    public <F extends KeyedProcessFunction<K, I, O> & LatenessAware> KeyedLatenessOperator(F function) {
        super(function);
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
