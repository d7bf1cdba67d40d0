package io.furrow.analytics.temperature;

import java.util.ArrayList;

import org.apache.flink.api.common.functions.AggregateFunction;

/** Keeps the values of a device in a window and nothing else of its records. */
final class CollectReadings implements AggregateFunction<FieldReading, DeviceReadings, DeviceReadings> {
    private static final long serialVersionUID = 1L;

    @Override
    public DeviceReadings createAccumulator() {
        return new DeviceReadings(null, null, Long.MIN_VALUE, null, null, new ArrayList<>());
    }

    @Override
    public DeviceReadings add(FieldReading from, DeviceReadings so) {
        Reading reading = from.reading();
        so.values().add(reading.value());
        boolean newer = from.validFrom() >= so.validFrom();
        return new DeviceReadings(
                from.field(),
                newer ? from.domain() : so.domain(),
                newer ? from.validFrom() : so.validFrom(),
                reading.input(),
                reading.device(),
                so.values());
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
