package io.furrow.cli.compare;

import java.util.ArrayList;
import java.util.List;

import io.furrow.cli.compare.AnalyticsResult.Average;
import io.furrow.cli.compare.AnalyticsResult.Encounter;

/**
 * Determines the differences between two results of the same subject. Distances and means differ from a thousandth of
 * their unit on: sums of the same readings in another order differ far less. Unknown ends of open results, and
 * everything outside of the range, count as equal.
 */
final class ChangeRule {
    private static final double MIN = 0.001;

    private final TimeRange range;

    ChangeRule(TimeRange range) {
        this.range = range;
    }

    List<MemberDifference> changes(AnalyticsResult a, AnalyticsResult b) {
        List<MemberDifference> changes = new ArrayList<>();
        if (a instanceof Average first && b instanceof Average second) {
            average(first, second, changes);
            return changes;
        }
        if (a instanceof Encounter first && b instanceof Encounter second) {
            moved("closest", first.closest(), second.closest(), changes);
        }
        if (range.start(a) != range.start(b)) {
            changes.add(new MemberDifference("start", a.start(), b.start()));
        }
        if (!a.isOpen() && !b.isOpen() && range.end(a) != range.end(b)) {
            changes.add(new MemberDifference("end", a.end(), b.end()));
        }
        return changes;
    }

    private static void average(Average a, Average b, List<MemberDifference> changes) {
        moved("mean", a.mean(), b.mean(), changes);
        if (!a.suspects().equals(b.suspects())) {
            changes.add(new MemberDifference("suspects", a.suspects(), b.suspects()));
        }
        if (!a.quality().equals(b.quality())) {
            changes.add(new MemberDifference("quality", a.quality(), b.quality()));
        }
    }

    private static void moved(String member, double a, double b, List<MemberDifference> changes) {
        boolean same = Double.isNaN(a) ? Double.isNaN(b) : Math.abs(a - b) < MIN;
        if (!same) {
            changes.add(new MemberDifference(member, Double.isNaN(a) ? null : a, Double.isNaN(b) ? null : b));
        }
    }
}
