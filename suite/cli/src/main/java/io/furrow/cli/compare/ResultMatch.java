package io.furrow.cli.compare;

import java.util.List;

/**
 * A result on both sides, or on only one of them.
 *
 * @param a null if only B has it
 * @param b null if only A has it
 * @param changes empty if both are the same, or one is missing
 */
record ResultMatch(AnalyticsResult a, AnalyticsResult b, List<MemberDifference> changes) {
    enum Verdict {
        SAME("same"),
        CHANGED("changed"),
        ONLY_A("only in A"),
        ONLY_B("only in B");

        private final String code;

        Verdict(String code) {
            this.code = code;
        }

        String code() {
            return code;
        }
    }

    ResultMatch {
        changes = List.copyOf(changes);
    }

    Verdict verdict() {
        if (a == null) {
            return Verdict.ONLY_B;
        } else if (b == null) {
            return Verdict.ONLY_A;
        }
        return changes.isEmpty() ? Verdict.SAME : Verdict.CHANGED;
    }

    /** The result of A, else that of B. */
    AnalyticsResult either() {
        return a == null ? b : a;
    }

    ResultSubject subject() {
        return either().subject();
    }

    /** The earlier start of both. */
    long start() {
        return a == null || b == null ? either().start() : Math.min(a.start(), b.start());
    }
}
