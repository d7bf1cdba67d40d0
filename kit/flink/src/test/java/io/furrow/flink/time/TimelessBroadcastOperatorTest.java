package io.furrow.flink.time;

import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.co.BroadcastProcessFunction;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.streaming.api.operators.TwoInputStreamOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;
import org.apache.flink.streaming.util.KeyedTwoInputStreamOperatorTestHarness;
import org.apache.flink.streaming.util.TwoInputStreamOperatorTestHarness;
import org.apache.flink.util.Collector;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class TimelessBroadcastOperatorTest {
    @Test
    void takesTheWatermarksOfTheEventsAlone() throws Exception {
        takesTheWatermarksOfTheEventsAlone(
                new TwoInputStreamOperatorTestHarness<>(new TimelessBroadcastOperator<>(new Events(), List.of())));
    }

    @Test
    void takesTheWatermarksOfKeyedEventsAlone() throws Exception {
        TwoInputStreamOperator<String, String, String> operator =
                new KeyedTimelessBroadcastOperator<>(new KeyedEvents(), List.of());
        takesTheWatermarksOfTheEventsAlone(
                new KeyedTwoInputStreamOperatorTestHarness<>(operator, event -> event, null, Types.STRING));
    }

    private static void takesTheWatermarksOfTheEventsAlone(
            TwoInputStreamOperatorTestHarness<String, String, String> harness) throws Exception {
        harness.open();

        harness.processWatermark1(new Watermark(10)); // before anything is known of the broadcast stream
        harness.processWatermarkStatus2(WatermarkStatus.ACTIVE);
        harness.processWatermark2(new Watermark(5));
        harness.processWatermark1(new Watermark(20));
        harness.processWatermark2(Watermark.MAX_WATERMARK);
        harness.processWatermark1(new Watermark(30));
        harness.processWatermarkStatus1(WatermarkStatus.IDLE);
        harness.processWatermarkStatus2(WatermarkStatus.IDLE);
        harness.processWatermarkStatus1(WatermarkStatus.ACTIVE);
        harness.processWatermark1(Watermark.MAX_WATERMARK);

        assertThat(harness.getOutput())
                .containsExactly(
                        new Watermark(10),
                        new Watermark(20),
                        new Watermark(30),
                        WatermarkStatus.IDLE,
                        WatermarkStatus.ACTIVE,
                        Watermark.MAX_WATERMARK);
        harness.close();
    }

    private static final class Events extends BroadcastProcessFunction<String, String, String> {
        private static final long serialVersionUID = 1L;

        @Override
        public void processElement(String event, ReadOnlyContext context, Collector<String> out) {}

        @Override
        public void processBroadcastElement(String record, Context context, Collector<String> out) {}
    }

    private static final class KeyedEvents extends KeyedBroadcastProcessFunction<String, String, String, String> {
        private static final long serialVersionUID = 1L;

        @Override
        public void processElement(String event, ReadOnlyContext context, Collector<String> out) {}

        @Override
        public void processBroadcastElement(String record, Context context, Collector<String> out) {}
    }
}
