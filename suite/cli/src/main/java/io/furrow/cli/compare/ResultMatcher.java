package io.furrow.cli.compare;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.HashSet;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import io.furrow.cli.compare.AnalyticsResult.Average;

/**
 * Matches each result of A with the equivalent result of B: of the same subject, encounters and stays with the longest
 * overlap first, averages of the same window. Times that only touch overlap. A result has at most one counterpart.
 */
final class ResultMatcher {
    /** Two equivalent results of one subject. */
    private record Candidate(AnalyticsResult a, AnalyticsResult b) {
        long common() {
            return Math.min(a.end(), b.end()) - Math.max(a.start(), b.start());
        }

        boolean isPossible() {
            return a instanceof Average ? a.start() == b.start() && a.end() == b.end() : common() >= 0;
        }
    }

    private ResultMatcher() {}

    /** Pairs of A and B, with null for a missing counterpart. */
    static List<ResultMatch> match(List<AnalyticsResult> a, List<AnalyticsResult> b, ChangeRule rule) {
        Map<ResultSubject, List<AnalyticsResult>> bySubject =
                b.stream().collect(Collectors.groupingBy(AnalyticsResult::subject));
        Map<ResultSubject, List<AnalyticsResult>> ofA =
                a.stream().collect(Collectors.groupingBy(AnalyticsResult::subject));
        Set<ResultSubject> subjects = new HashSet<>(ofA.keySet());
        subjects.addAll(bySubject.keySet());
        List<ResultMatch> matches = new ArrayList<>();
        for (ResultSubject subject : subjects) {
            matches.addAll(
                    ofOne(ofA.getOrDefault(subject, List.of()), bySubject.getOrDefault(subject, List.of()), rule));
        }
        matches.sort(Comparator.comparingLong(ResultMatch::start).thenComparing(ResultMatch::subject));
        return matches;
    }

    private static List<ResultMatch> ofOne(List<AnalyticsResult> a, List<AnalyticsResult> b, ChangeRule rule) {
        Set<AnalyticsResult> free = identitySet(a);
        free.addAll(b);
        List<ResultMatch> matches = new ArrayList<>();
        for (Candidate candidate : candidates(a, b)) {
            if (free.contains(candidate.a) && free.contains(candidate.b)) {
                free.remove(candidate.a);
                free.remove(candidate.b);
                matches.add(new ResultMatch(candidate.a, candidate.b, rule.changes(candidate.a, candidate.b)));
            }
        }
        a.stream().filter(free::contains).forEach(one -> matches.add(new ResultMatch(one, null, List.of())));
        b.stream().filter(free::contains).forEach(one -> matches.add(new ResultMatch(null, one, List.of())));
        return matches;
    }

    /** The longest overlap first. */
    private static List<Candidate> candidates(List<AnalyticsResult> a, List<AnalyticsResult> b) {
        if (!a.isEmpty() && a.get(0) instanceof Average) {
            return windows(a, b);
        }
        List<Candidate> candidates = new ArrayList<>();
        for (AnalyticsResult one : a) {
            for (AnalyticsResult other : b) {
                Candidate candidate = new Candidate(one, other);
                if (candidate.isPossible()) {
                    candidates.add(candidate);
                }
            }
        }
        candidates.sort(Comparator.comparingLong(Candidate::common)
                .reversed()
                .thenComparing(candidate -> candidate.a.start())
                .thenComparing(candidate -> candidate.b.start()));
        return candidates;
    }

    /** Separate, because a long recording has many windows of a field, each with at most one counterpart. */
    private static List<Candidate> windows(List<AnalyticsResult> a, List<AnalyticsResult> b) {
        Map<List<Long>, AnalyticsResult> ofB = new HashMap<>();
        b.forEach(one -> ofB.put(List.of(one.start(), one.end()), one));
        List<Candidate> candidates = new ArrayList<>();
        for (AnalyticsResult one : a) {
            AnalyticsResult other = ofB.get(List.of(one.start(), one.end()));
            if (other != null) {
                candidates.add(new Candidate(one, other));
            }
        }
        return candidates;
    }

    private static Set<AnalyticsResult> identitySet(List<AnalyticsResult> spans) {
        Set<AnalyticsResult> set = java.util.Collections.newSetFromMap(new IdentityHashMap<>());
        set.addAll(spans);
        return set;
    }
}
