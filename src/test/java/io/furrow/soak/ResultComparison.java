package io.furrow.soak;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;

/**
 * The differences between actual and expected results of a topic.
 *
 * @param required number of required results
 * @param missing required but absent
 * @param repeated present more than once
 * @param wrong unexpected, or with another value
 */
record ResultComparison(int required, List<String> missing, List<String> repeated, List<String> wrong) {
    /** @param horizon epoch ms; results that are known later are optional */
    static ResultComparison of(List<Result> expected, List<Result> actual, long horizon) {
        Map<String, String> values = new HashMap<>();
        expected.forEach(result -> values.put(result.name(), result.value()));
        Map<String, String> found = new HashMap<>();
        List<String> repeated = new ArrayList<>();
        List<String> wrong = new ArrayList<>();
        for (Result result : actual) {
            if (found.put(result.name(), result.value()) != null) {
                repeated.add(result.name());
            } else if (!result.value().equals(values.get(result.name()))) {
                wrong.add(result.name() + " is " + result.value() + " instead of " + values.get(result.name()));
            }
        }
        Predicate<Result> due = result -> result.time() <= horizon;
        List<String> missing = expected.stream()
                .filter(due.and(result -> !found.containsKey(result.name())))
                .map(Result::name)
                .toList();
        return new ResultComparison((int) expected.stream().filter(due).count(), missing, repeated, wrong);
    }

    boolean isClean() {
        return required > 0 && missing.isEmpty() && repeated.isEmpty() && wrong.isEmpty();
    }

    @Override
    public String toString() {
        return "%5d required, %d missing, %d repeated, %d wrong"
                .formatted(required, missing.size(), repeated.size(), wrong.size());
    }
}
