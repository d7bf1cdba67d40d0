package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/**
 * The measurements of one device in one field and window.
 *
 * @param type of its entity
 * @param values in the attribute's unit, distinct, in rising order
 * @param times count of each value
 */
public record CountedValues(String type, List<Double> values, List<Integer> times) {
    static CountedValues none(String type) {
        return new CountedValues(type, new ArrayList<>(), new ArrayList<>());
    }

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
