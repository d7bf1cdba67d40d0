package io.furrow.analytics.temperature.window;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

import io.furrow.analytics.temperature.InputScope;

/**
 * What one device measured in one field and window so far; the state of a window that is still open.
 *
 * @param domain of the field, as of its newest version that a reading knows
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param values in the attribute's unit, each once, in rising order
 * @param times how often each came; null in state of before it was counted: then values are in order of arrival, repeated
 */
public record DeviceReadings(
        String field,
        String domain,
        long validFrom,
        InputScope scope,
        String device,
        List<Double> values,
        List<Integer> times) {
    /** Counts a value. The lists are those of the state and are changed in place. */
    void add(double value) {
        int at = Collections.binarySearch(values, value);
        if (at >= 0) {
            times.set(at, times.get(at) + 1);
        } else {
            values.add(-at - 1, value);
            times.add(-at - 1, 1);
        }
    }

    /** The same with values counted. */
    DeviceReadings counted() {
        if (times != null) {
            return this;
        }
        DeviceReadings counted =
                new DeviceReadings(field, domain, validFrom, scope, device, new ArrayList<>(), new ArrayList<>());
        values.forEach(counted::add);
        return counted;
    }

    /** Of all values, each as often as it came. */
    public double median() {
        DeviceReadings counted = counted();
        int all = counted.times.stream().mapToInt(Integer::intValue).sum();
        double upper = counted.inOrder(all / 2);
        return all % 2 == 1 ? upper : (counted.inOrder(all / 2 - 1) + upper) / 2;
    }

    private double inOrder(int index) {
        int at = 0;
        for (int left = index - times.get(0); left >= 0; left -= times.get(at)) {
            at++;
        }
        return values.get(at);
    }
}
