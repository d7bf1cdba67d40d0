package io.furrow.analytics.temperature;

import org.apache.flink.streaming.api.functions.windowing.WindowFunction;
import org.apache.flink.streaming.api.windowing.windows.TimeWindow;
import org.apache.flink.util.Collector;

/**
 * Gives a device one vote in a field's window: a device that reports often counts no more than one that reports rarely.
 *
 * <p>State: the values of each device, field and window with their counts ({@link DeviceReadings}). Cleared: with the window, when the
 * watermark passes its end and the allowed lateness. Late: within the allowed lateness the vote is cast again; after it the reading goes to
 * the side output. Emits: the median, when the watermark passes the end of the window.
 */
final class CastVote implements WindowFunction<DeviceReadings, DeviceVote, String, TimeWindow> {
    private static final long serialVersionUID = 1L;

    @Override
    public void apply(String voter, TimeWindow window, Iterable<DeviceReadings> only, Collector<DeviceVote> out) {
        for (DeviceReadings readings : only) {
            out.collect(new DeviceVote(
                    readings.field(),
                    readings.domain(),
                    readings.validFrom(),
                    readings.scope(),
                    readings.device(),
                    readings.median(),
                    window.getStart(),
                    window.getEnd(),
                    readings.type()));
        }
    }
}
