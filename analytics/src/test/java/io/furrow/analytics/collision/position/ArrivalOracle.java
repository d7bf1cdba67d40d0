package io.furrow.analytics.collision.position;

import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;

import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.position.PositionFix;

/**
 * What is reported at once, as a definition: after each arrival every pair of the newest positions, nothing of grids or versions.
 * A position counts until the watermark, which follows each arrival, has passed its time-to-live.
 */
public final class ArrivalOracle {
    private final CollisionRules rules;
    private final Map<String, PositionFix> newest = new HashMap<>();
    private final Set<Pair> close = new HashSet<>();
    private final Set<String> told = new TreeSet<>();
    private long watermark = Long.MIN_VALUE;

    private ArrivalOracle(CollisionRules rules) {
        this.rules = rules.whileBothCount();
    }

    /** Ids of the provisional records where positions arrive in this order. */
    public static Set<String> provisional(List<PositionFix> arrivals, CollisionRules rules) {
        ArrivalOracle oracle = new ArrivalOracle(rules);
        arrivals.forEach(oracle::arrives);
        return oracle.told;
    }

    private void arrives(PositionFix fix) {
        forgetTheSilent();
        watermark = Math.max(watermark, fix.time() - DetectionRun.BOUND - 1);
        PositionFix before = newest.get(fix.identity());
        if (before != null && PositionFix.SEQUENCE.compare(fix, before) <= 0) {
            return;
        }
        newest.put(fix.identity(), fix);
        for (PositionFix other : newest.values()) {
            if (!other.identity().equals(fix.identity())) {
                boolean inOrder = PositionFix.NAMING.compare(fix, other) < 0;
                compare(inOrder ? fix : other, inOrder ? other : fix);
            }
        }
    }

    private void forgetTheSilent() {
        long timeToLive = rules.timeToLive().toMillis();
        List<PositionFix> silent = newest.values().stream()
                .filter(fix -> fix.time() + timeToLive <= watermark)
                .toList();
        for (PositionFix fix : silent) {
            newest.remove(fix.identity());
            close.removeIf(
                    pair -> pair.first().equals(fix.identity()) || pair.second().equals(fix.identity()));
        }
    }

    private void compare(PositionFix first, PositionFix second) {
        Pair pair = Pair.of(first, second);
        if (!isClose(first, second)) {
            close.remove(pair);
        } else if (close.add(pair)) {
            told.add(Encounter.provisional(first, second).id());
        }
    }

    private boolean isClose(PositionFix first, PositionFix second) {
        return Math.abs(first.time() - second.time()) <= rules.maxSkew().toMillis()
                && Geodesy.distance(first, second) <= rules.thresholds().between(first.type(), second.type())
                && !first.sharesAggregateWith(second)
                && counts(first)
                && counts(second);
    }

    private boolean counts(PositionFix fix) {
        return !rules.positions().zones().cover(fix.latitude(), fix.longitude());
    }
}
