package io.furrow.analytics.temperature;

import java.util.Collections;
import java.util.List;

/**
 * The measurements so far of one device in one field and window; the state of an open window. Before the first reading
 * all but the lists is null.
 *
 * @param domain of the field, as of the newest version among the readings
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param type of the entity
 * @param values in the attribute's unit, distinct, in rising order
 * @param times count of each value
 */
public record DeviceReadings(
        String field,
        String domain,
        long validFrom,
        InputScope scope,
        String device,
        String type,
        List<Double> values,
        List<Integer> times) {
    /** Counts a value. The lists are those of the state and are changed in place. */
    void count(double value) {
        int at = Collections.binarySearch(values, value);
        if (at >= 0) {
            times.set(at, times.get(at) + 1);
        } else {
            values.add(-at - 1, value);
            times.add(-at - 1, 1);
        }
    }

    /** The median of all values, weighted by their counts. */
    double median() {
        int all = times.stream().mapToInt(Integer::intValue).sum();
        double upper = inOrder(all / 2);
        return all % 2 == 1 ? upper : (inOrder(all / 2 - 1) + upper) / 2;
    }

    private double inOrder(int index) {
        int at = 0;
        for (int left = index - times.get(0); left >= 0; left -= times.get(at)) {
            at++;
        }
        return values.get(at);
    }
}
