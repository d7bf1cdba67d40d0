package io.furrow.flink.time;

import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutputMultiplexer;

import io.furrow.flink.record.TopicRecord;

/** A partition whose watermarks are combined with those of others as Flink combines them. */
record TestPartition(String name, WatermarkGenerator<TopicRecord> watermarks, WatermarkOutputMultiplexer combined) {
    TestPartition {
        combined.registerNewOutput(name, new WatermarkOutputMultiplexer.WatermarkUpdateListener() {
            @Override
            public void onWatermarkUpdate(long watermark) {}

            @Override
            public void onIdleUpdate(boolean isIdle) {}
        });
    }

    void read(TopicRecord record, long time) {
        watermarks.onEvent(record, time, combined.getImmediateOutput(name));
    }

    void idle() {
        combined.getImmediateOutput(name).markIdle();
    }

    void emit() {
        watermarks.onPeriodicEmit(combined.getDeferredOutput(name));
    }
}
