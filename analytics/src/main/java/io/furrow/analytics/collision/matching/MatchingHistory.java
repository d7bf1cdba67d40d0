package io.furrow.analytics.collision.matching;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.TreeMap;

/**
 * By which rules pairs are matched at which instant. Rules change between a savepoint and what is restored from it: at the
 * instant to which event time had come, who was close is judged by the rules of before and who is close by the new ones, so
 * that encounters that are none any more end there, and those that are new begin there.
 */
final class MatchingHistory {
    private final KnownRules rules;
    private final Matching matching;
    /** By the last instant at which what had been before is judged so. */
    private final TreeMap<Long, Former> former = new TreeMap<>();

    private record Former(KnownRules rules, Matching matching) {}

    /** @param matching by the rules that count from now on */
    MatchingHistory(KnownRules rules, Matching matching) {
        this.rules = rules;
        this.matching = matching;
    }

    /**
     * Takes up what state knows.
     *
     * @param known of all subtasks, in any order
     * @param reached event time when it was written
     */
    void restore(Iterable<RulesUntil> known, long reached) {
        List<RulesUntil> inOrder = new ArrayList<>();
        known.forEach(inOrder::add);
        inOrder.sort(Comparator.comparingLong(RulesUntil::until));
        for (RulesUntil each : inOrder) {
            if (each.until() != RulesUntil.NOW) {
                add(each.rules(), each.until());
            } else if (!each.rules().equals(rules)) {
                add(each.rules(), reached);
            }
        }
    }

    private void add(KnownRules rulesThen, long until) {
        former.putIfAbsent(until, new Former(rulesThen, new Matching(rulesThen.inCells())));
    }

    /** For who was close before an instant. */
    Matching before(long time) {
        return former.isEmpty() || former.ceilingEntry(time) == null
                ? matching
                : former.ceilingEntry(time).getValue().matching;
    }

    /** For who is close from an instant on. */
    Matching from(long time) {
        return former.isEmpty() || former.higherEntry(time) == null
                ? matching
                : former.higherEntry(time).getValue().matching;
    }

    /** Whether the rules change at an instant. */
    boolean isTurn(long time) {
        return !former.isEmpty() && former.containsKey(time);
    }

    /** Nothing of up to this instant can come any more. */
    void passed(long time) {
        if (!former.isEmpty()) {
            former.headMap(time, true).clear();
        }
    }

    List<RulesUntil> toSave() {
        List<RulesUntil> all = new ArrayList<>();
        former.forEach((until, each) -> all.add(new RulesUntil(each.rules, until)));
        all.add(new RulesUntil(rules, RulesUntil.NOW));
        return all;
    }
}
