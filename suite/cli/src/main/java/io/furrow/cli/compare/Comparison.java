package io.furrow.cli.compare;

import java.util.EnumMap;
import java.util.List;
import java.util.Map;

import io.furrow.cli.compare.Match.Verdict;

/**
 * How what analytics found on two sides differs.
 *
 * @param matches by kind, in the order of time
 */
record Comparison(FoundResults a, FoundResults b, TimeRange range, Map<ResultKind, List<Match>> matches) {
    /** Compares what lies within a range. */
    static Comparison of(FoundResults a, FoundResults b, TimeRange range) {
        boolean oneScope = a.scopes() <= 1 && b.scopes() <= 1;
        Map<ResultKind, List<Match>> matches = new EnumMap<>(ResultKind.class);
        for (ResultKind kind : ResultKind.values()) {
            List<Match> all = SpanMatcher.match(
                    within(range, a.spans().get(kind), oneScope),
                    within(range, b.spans().get(kind), oneScope),
                    new ChangeRule(range));
            // A window in which nothing was reported is as good as none: whether a job still reports it depends on
            // where its input ends.
            matches.put(
                    kind,
                    all.stream()
                            .filter(match -> match.a() != null && match.b() != null || !isEmpty(match.either()))
                            .toList());
        }
        return new Comparison(a, b, range, Map.copyOf(matches));
    }

    private static boolean isEmpty(Span span) {
        return span instanceof Average average && average.isEmpty();
    }

    private static List<Span> within(TimeRange range, List<Span> spans, boolean oneScope) {
        return spans.stream()
                .filter(span -> span instanceof Average window ? range.contains(window) : range.overlaps(span))
                .map(span -> oneScope ? span.of(span.subject().anyScope()) : span)
                .toList();
    }

    boolean isSame() {
        return matches.values().stream().flatMap(List::stream).allMatch(match -> match.verdict() == Verdict.SAME);
    }

    long count(ResultKind kind, Verdict verdict) {
        return matches.get(kind).stream()
                .filter(match -> match.verdict() == verdict)
                .count();
    }

    List<Match> differences(ResultKind kind) {
        return matches.get(kind).stream()
                .filter(match -> match.verdict() != Verdict.SAME)
                .toList();
    }

    /** Whether neither side has a topic of it. */
    boolean isUnknown(ResultKind kind) {
        return a.missing().contains(kind) && b.missing().contains(kind);
    }
}
