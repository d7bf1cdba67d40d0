package io.furrow.analytics.temperature.window;

import java.util.ArrayList;

import org.apache.flink.api.common.functions.AggregateFunction;

import io.furrow.analytics.temperature.FieldReading;
import io.furrow.analytics.temperature.Reading;

/**
 * Collects the values of a device in a window, and nothing else of its records. A state backend on disk reads and
 * writes all of that with every reading; values are counted, because a sensor that reports each second of a day has
 * few different ones.
 */
public final class CollectReadings implements AggregateFunction<FieldReading, DeviceReadings, DeviceReadings> {
    private static final long serialVersionUID = 1L;

    @Override
    public DeviceReadings createAccumulator() {
        return new DeviceReadings(null, null, Long.MIN_VALUE, null, null, new ArrayList<>(), new ArrayList<>());
    }

    @Override
    public DeviceReadings add(FieldReading from, DeviceReadings before) {
        Reading reading = from.reading();
        DeviceReadings so = before.counted();
        so.add(reading.value());
        boolean newer = from.validFrom() >= so.validFrom();
        return new DeviceReadings(
                from.field(),
                newer ? from.domain() : so.domain(),
                newer ? from.validFrom() : so.validFrom(),
                reading.input(),
                reading.device(),
                so.values(),
                so.times());
    }

    @Override
    public DeviceReadings getResult(DeviceReadings readings) {
        return readings;
    }

    /** Only session windows merge. */
    @Override
    public DeviceReadings merge(DeviceReadings one, DeviceReadings other) {
        throw new UnsupportedOperationException("windows of a fixed length do not merge");
    }
}
