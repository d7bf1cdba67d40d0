package io.furrow.analytics.temperature;

import java.time.Duration;

import org.apache.flink.api.common.serialization.SerializerConfig;
import org.apache.flink.api.common.state.AggregatingStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.runtime.state.StateInitializationContext;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.api.windowing.triggers.EventTimeTrigger;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;
import org.apache.flink.streaming.runtime.operators.windowing.WindowOperator;
import org.apache.flink.streaming.runtime.operators.windowing.functions.InternalSingleValueWindowFunction;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.util.OutputTag;

import io.furrow.flink.time.EventTimeProgress;

/**
 * Flink's windows with {@link CollectReadings} and {@link CastVote}, except that a window closed by an earlier run stays
 * closed: Flink would reopen it for elements that arrive before the first watermark after a restart.
 */
final class CastVotes extends WindowOperator<String, FieldReading, DeviceReadings, DeviceVote, TimeWindow> {
    private static final long serialVersionUID = 1L;
    /** Flink's name of the state, for compatibility with its own windows. */
    private static final String STATE = "window-contents";

    private transient EventTimeProgress reached;

    /**
     * @param late receives readings whose windows are all closed
     * @param readings by the key of a device in a field
     */
    CastVotes(
            EpochWindows windows,
            Duration allowedLateness,
            OutputTag<FieldReading> late,
            KeyedStream<FieldReading, String> readings) {
        super(
                windows,
                windows.getWindowSerializer(readings.getExecutionConfig()),
                readings.getKeySelector(),
                readings.getKeyType().createSerializer(serializers(readings)),
                new AggregatingStateDescriptor<>(
                        STATE,
                        new CollectReadings(),
                        TypeInformation.of(DeviceReadings.class).createSerializer(serializers(readings))),
                new InternalSingleValueWindowFunction<>(new CastVote()),
                EventTimeTrigger.create(),
                allowedLateness.toMillis(),
                late);
    }

    private static SerializerConfig serializers(KeyedStream<?, ?> stream) {
        return stream.getExecutionConfig().getSerializerConfig();
    }

    @Override
    public void initializeState(StateInitializationContext context) throws Exception {
        super.initializeState(context);
        reached = EventTimeProgress.restore(context.getOperatorStateStore(), getRuntimeContext());
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        reached.advance(mark.getTimestamp());
        super.processWatermark(mark);
    }

    @Override
    protected boolean isWindowLate(TimeWindow window) {
        return super.isWindowLate(window)
                || reached.hasPassed(window.maxTimestamp() + allowedLateness, getCurrentKey());
    }

    @Override
    protected boolean isElementLate(StreamRecord<FieldReading> reading) {
        return super.isElementLate(reading)
                || reached.hasPassed(reading.getTimestamp() + allowedLateness, getCurrentKey());
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        reached.snapshot();
    }
}
