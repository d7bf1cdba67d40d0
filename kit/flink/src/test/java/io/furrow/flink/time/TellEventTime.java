package io.furrow.flink.time;

import java.util.Map;

import org.apache.flink.streaming.api.functions.co.CoProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.TopicRecord;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Emits the event time at each change, to the topic {@code seen}. */
public final class TellEventTime extends CoProcessFunction<TopicRecord, TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 1L;

    @Override
    public void processElement1(TopicRecord event, Context context, Collector<TopicRecord> out) {
        // moves event time
    }

    @Override
    public void processElement2(TopicRecord change, Context context, Collector<TopicRecord> out) {
        byte[] time = Long.toString(context.timerService().currentWatermark()).getBytes(UTF_8);
        out.collect(new TopicRecord("seen", 0, 0, 0, null, time, Map.of()));
    }
}
