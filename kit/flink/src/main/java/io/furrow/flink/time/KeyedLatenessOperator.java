package io.furrow.flink.time;

import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;

/**
 * Runs a keyed function that judges what is late. The operator sees every watermark, a function only those at which something
 * comes or is due, so it keeps how far event time has come.
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
        reached = EventTimeProgress.restore(
                context.getOperatorStateStore(), getRuntimeContext().getTaskInfo());
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
