package io.furrow.analytics.temperature;

import java.util.ArrayList;

import org.apache.flink.api.common.functions.AggregateFunction;

/**
 * Collects only the values of a device in a window, because a state backend on disk reads and writes all of it
 * with every reading. Values are counted, because a sensor that reports each second of a day has few different ones.
 */
final class CollectReadings implements AggregateFunction<FieldReading, DeviceReadings, DeviceReadings> {
    private static final long serialVersionUID = 1L;

    @Override
    public DeviceReadings createAccumulator() {
        return new DeviceReadings(null, null, Long.MIN_VALUE, null, null, null, new ArrayList<>(), new ArrayList<>());
    }

    @Override
    public DeviceReadings add(FieldReading from, DeviceReadings before) {
        before.count(from.reading().value());
        boolean newer = from.validFrom() >= before.validFrom();
        return new DeviceReadings(
                from.field(),
                newer ? from.domain() : before.domain(),
                newer ? from.validFrom() : before.validFrom(),
                from.reading().input(),
                from.reading().device(),
                from.reading().type(),
                before.values(),
                before.times());
    }

    @Override
    public DeviceReadings getResult(DeviceReadings readings) {
        return readings;
    }

    /** Never called: only session windows merge. */
    @Override
    public DeviceReadings merge(DeviceReadings one, DeviceReadings other) {
        throw new UnsupportedOperationException("windows of a fixed length do not merge");
    }
}
