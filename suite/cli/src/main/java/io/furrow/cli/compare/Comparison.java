package io.furrow.cli.compare;

import java.util.EnumMap;
import java.util.List;
import java.util.Map;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.ResultMatch.Verdict;

/**
 * The differences between the analytics results of two sides.
 *
 * @param matches by kind, in order of time
 */
record Comparison(SideResults a, SideResults b, TimeRange range, Map<ResultKind, List<ResultMatch>> matches) {
    /** Compares the results within a range. */
    static Comparison of(SideResults a, SideResults b, TimeRange range) {
        boolean oneScope = a.scopes() <= 1 && b.scopes() <= 1;
        Map<ResultKind, List<ResultMatch>> matches = new EnumMap<>(ResultKind.class);
        for (ResultKind kind : ResultKind.values()) {
            List<ResultMatch> all = ResultMatcher.match(
                    within(range, a.spans().get(kind), oneScope),
                    within(range, b.spans().get(kind), oneScope),
                    new ChangeRule(range));
            // A window without readings equals a missing one: whether a job reports it depends on where its input ends.
            matches.put(
                    kind,
                    all.stream()
                            .filter(match -> match.a() != null && match.b() != null || !hasNoReadings(match.either()))
                            .toList());
        }
        return new Comparison(a, b, range, Map.copyOf(matches));
    }

    private static boolean hasNoReadings(AnalyticsResult span) {
        return span instanceof Average average && average.isEmpty();
    }

    private static List<AnalyticsResult> within(TimeRange range, List<AnalyticsResult> spans, boolean oneScope) {
        return spans.stream()
                .filter(span -> span instanceof Average window ? range.contains(window) : range.overlaps(span))
                .map(span -> oneScope ? span.of(span.subject().anyScope()) : span)
                .toList();
    }

    /** Whether neither side has a result within the range. */
    boolean isEmpty() {
        return matches.values().stream().allMatch(List::isEmpty);
    }

    boolean isSame() {
        return matches.values().stream().flatMap(List::stream).allMatch(match -> match.verdict() == Verdict.SAME);
    }

    long count(ResultKind kind, Verdict verdict) {
        return matches.get(kind).stream()
                .filter(match -> match.verdict() == verdict)
                .count();
    }

    List<ResultMatch> differences(ResultKind kind) {
        return matches.get(kind).stream()
                .filter(match -> match.verdict() != Verdict.SAME)
                .toList();
    }

    /** Whether neither side has a topic of this kind. */
    boolean isUnknown(ResultKind kind) {
        return a.missing().contains(kind) && b.missing().contains(kind);
    }
}
