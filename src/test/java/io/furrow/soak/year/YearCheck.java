package io.furrow.soak.year;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.TreeSet;

/**
 * The result of a check.
 *
 * @param figures counts
 * @param differences empty if the check succeeded
 */
record YearCheck(String what, String figures, List<String> differences) {
    boolean holds() {
        return differences.isEmpty();
    }

    /** Missing, unexpected and different values. */
    static List<String> differences(Map<String, ?> expected, Map<String, ?> found) {
        List<String> differences = new ArrayList<>();
        Set<String> all = new TreeSet<>(expected.keySet());
        all.addAll(found.keySet());
        for (String each : all) {
            if (!Objects.equals(expected.get(each), found.get(each))) {
                differences.add("%s: %s instead of %s".formatted(each, found.get(each), expected.get(each)));
            }
        }
        return differences;
    }
}
