package io.furrow.analytics.temperature;

import java.util.List;
import java.util.stream.Stream;

/**
 * What the devices of one id measured in one field and window so far; the state of a window that is still open. Nearly always there is
 * one: those of further types are in a list.
 *
 * @param domain of the field, as of its newest version that a reading knows
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param values of the first device in the attribute's unit, each once, in rising order
 * @param times how often each came
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
    /** One of each type, the first in front. */
    List<CountedValues> all() {
        return others == null
                ? List.of(first())
                : Stream.concat(Stream.of(first()), others.stream()).toList();
    }

    private CountedValues first() {
        return new CountedValues(type, values, times);
    }
}
