package io.furrow.cli.compare;

import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

/**
 * The analytics results of one side of a comparison.
 *
 * @param name replay, or {@code live}
 * @param epoch of the replay; 0 of live results
 * @param spans results by kind
 * @param missing kinds without a topic: no result, or the job never ran
 */
record SideResults(String name, long epoch, Map<ResultKind, List<AnalyticsResult>> spans, Set<ResultKind> missing) {
    SideResults {
        Map<ResultKind, List<AnalyticsResult>> all = new EnumMap<>(ResultKind.class);
        for (ResultKind kind : ResultKind.values()) {
            all.put(kind, List.copyOf(spans.getOrDefault(kind, List.of())));
        }
        spans = Map.copyOf(all);
        missing = Set.copyOf(missing);
    }

    /** Number of tenants and service paths. */
    long scopes() {
        return spans.values().stream()
                .flatMap(List::stream)
                .map(span -> span.subject().scope())
                .distinct()
                .count();
    }
}
