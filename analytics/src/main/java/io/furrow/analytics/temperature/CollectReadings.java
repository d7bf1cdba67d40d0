package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.functions.AggregateFunction;

/**
 * Collects only the values of the devices of an id in a window, because a state backend on disk reads and writes all of it
 * with every reading. Values are counted, because a sensor that reports each second of a day has few different ones.
 */
final class CollectReadings implements AggregateFunction<FieldReading, DeviceReadings, DeviceReadings> {
    private static final long serialVersionUID = 1L;

    @Override
    public DeviceReadings createAccumulator() {
        return new DeviceReadings(
                null, null, Long.MIN_VALUE, null, null, new ArrayList<>(), new ArrayList<>(), null, null);
    }

    @Override
    public DeviceReadings add(FieldReading from, DeviceReadings before) {
        Reading reading = from.reading();
        List<CountedValues> all = new ArrayList<>(before.all());
        CountedValues first = all.remove(0);
        String type = first.type() == null ? reading.type() : first.type();
        valuesOf(reading.type(), type, first, all).add(reading.value());
        boolean newer = from.validFrom() >= before.validFrom();
        return new DeviceReadings(
                from.field(),
                newer ? from.domain() : before.domain(),
                newer ? from.validFrom() : before.validFrom(),
                reading.input(),
                reading.device(),
                first.values(),
                first.times(),
                type,
                all.isEmpty() ? null : all);
    }

    private static CountedValues valuesOf(
            String type, String firstType, CountedValues first, List<CountedValues> others) {
        if (type.equals(firstType)) {
            return first;
        }
        for (CountedValues each : others) {
            if (type.equals(each.type())) {
                return each;
            }
        }
        others.add(CountedValues.none(type));
        return others.get(others.size() - 1);
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
