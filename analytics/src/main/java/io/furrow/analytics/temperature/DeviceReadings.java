package io.furrow.analytics.temperature;

import java.util.List;
import java.util.stream.Stream;

/**
 * The measurements so far of the devices of one id in one field and window; the state of an open window. Nearly always there is one
 * device: those of further types are in a list.
 *
 * @param domain of the field, as of the newest version among the readings
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param values of the first device in the attribute's unit, distinct, in rising order
 * @param times count of each value
 * @param type of the first device; null before the first reading
 * @param others devices of further types; null if there are none
 */
public record DeviceReadings(
        String field,
        String domain,
        long validFrom,
        InputScope scope,
        String device,
        List<Double> values,
        List<Integer> times,
        String type,
        List<CountedValues> others) {
    /** One of each type, the first one first. */
    List<CountedValues> all() {
        return others == null
                ? List.of(first())
                : Stream.concat(Stream.of(first()), others.stream()).toList();
    }

    private CountedValues first() {
        return new CountedValues(type, values, times);
    }
}
